#include "bench/peers/opencv_peer.h"

#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/video.hpp>

namespace etude {
namespace {

cv::Mat ViewOf(const ColourImage& picture) {
  return {picture.height, picture.width, CV_8UC3, const_cast<Rgb8*>(picture.pixels.data())};
}

struct Buffers {
  cv::Mat labels, stats, centroids, changed;
};

/// Fills each hole of at most `max_hole_px` pixels in the mask `person`, given its two-level contours (outlines and
/// holes). `outline` is the index of the person's contour. The contour of a hole lies on the person's pixels around the
/// hole.
void FillSmallHoles(const std::vector<std::vector<cv::Point>>& contours, const std::vector<cv::Vec4i>& hierarchy,
                    int outline, int max_hole_px, cv::Mat& person) {
  for (int i = hierarchy[static_cast<std::size_t>(outline)][2]; i >= 0; i = hierarchy[static_cast<std::size_t>(i)][0]) {
    const cv::Rect around = cv::boundingRect(contours[static_cast<std::size_t>(i)]);
    cv::Mat hole = cv::Mat::zeros(around.size(), CV_8U);
    cv::drawContours(hole, contours, i, 255, cv::FILLED, cv::LINE_8, cv::noArray(), 0, -around.tl());
    hole.setTo(0, person(around));
    if (cv::countNonZero(hole) <= max_hole_px) person(around).setTo(1, hole);
  }
}

/// Finds the largest 8-connected piece of `changed` by cv::connectedComponentsWithStats, and fills holes of at most
/// `max_hole_px` pixels by contours within the piece's bounding box.
void KeepPersonByLabels(const cv::Mat& changed, int max_hole_px, Buffers& b, Mask& out) {
  const int pieces = cv::connectedComponentsWithStats(changed, b.labels, b.stats, b.centroids, 8, CV_32S, cv::CCL_SAUF);
  int best = 0, area = 0;
  for (int i = 1; i < pieces; ++i) {
    if (b.stats.at<int>(i, cv::CC_STAT_AREA) <= area) continue;
    area = b.stats.at<int>(i, cv::CC_STAT_AREA);
    best = i;
  }
  if (best == 0) return;
  const cv::Rect box(b.stats.at<int>(best, cv::CC_STAT_LEFT), b.stats.at<int>(best, cv::CC_STAT_TOP),
                     b.stats.at<int>(best, cv::CC_STAT_WIDTH), b.stats.at<int>(best, cv::CC_STAT_HEIGHT));
  cv::Mat person = cv::Mat(out.height, out.width, CV_8U, out.pixels.data())(box);
  cv::compare(b.labels(box), best, person, cv::CMP_EQ);
  cv::bitwise_and(person, 1, person);
  std::vector<std::vector<cv::Point>> contours;
  std::vector<cv::Vec4i> hierarchy;
  cv::findContours(person, contours, hierarchy, cv::RETR_CCOMP, cv::CHAIN_APPROX_NONE);
  for (int i = 0; i >= 0 && !contours.empty(); i = hierarchy[static_cast<std::size_t>(i)][0]) {
    FillSmallHoles(contours, hierarchy, i, max_hole_px, person);
  }
}

/// Finds the contour with the largest area, draws it, and fills its small holes. No labels are computed, unlike in
/// KeepPersonByLabels.
void KeepPersonByContours(const cv::Mat& changed, int max_hole_px, Mask& out) {
  std::vector<std::vector<cv::Point>> contours;
  std::vector<cv::Vec4i> hierarchy;
  cv::findContours(changed, contours, hierarchy, cv::RETR_CCOMP, cv::CHAIN_APPROX_NONE);
  int best = -1;
  double area = -1;
  for (int i = contours.empty() ? -1 : 0; i >= 0; i = hierarchy[static_cast<std::size_t>(i)][0]) {
    const double here = cv::contourArea(contours[static_cast<std::size_t>(i)]);
    if (here <= area) continue;
    area = here;
    best = i;
  }
  if (best < 0) return;
  cv::Mat person(out.height, out.width, CV_8U, out.pixels.data());
  // With maxLevel 1, drawContours leaves the children of the contour, its holes, unfilled.
  cv::drawContours(person, contours, best, 1, cv::FILLED, cv::LINE_8, hierarchy, 1);
  FillSmallHoles(contours, hierarchy, best, max_hole_px, person);
}

}  // namespace

struct OpenCvPerson::State {
  Kind kind;
  int max_hole_px;
  double cosine2;
  int steps;               ///< the threshold in steps of cvtColor's hue (2°)
  cv::Mat bx, by3, reach;  ///< used only by kSameHue
  cv::Mat hue;             ///< used only by kHsv and kHsvContours
  cv::Mat chroma, planes[2], dot, own, tmp, mask, hsv, apart;
  Buffers buffers;

  void Chroma(const cv::Mat& rgb) {
    // The rows of the matrix compute 2R − G − B and G − B, which are whole numbers in floats. Grey gets the hue of red.
    static const cv::Matx23f kToChroma(2, -1, -1, 0, 1, -1);
    rgb.convertTo(tmp, CV_32F);
    cv::transform(tmp, chroma, kToChroma);
    cv::split(chroma, planes);
    cv::compare(planes[0], 0, mask, cv::CMP_EQ);
    cv::compare(planes[1], 0, apart, cv::CMP_EQ);
    cv::bitwise_and(mask, apart, mask);
    planes[0].setTo(510, mask);
  }
};

OpenCvPerson::OpenCvPerson(const ColourImage& background, double hue_threshold, int max_hole_px, Kind kind)
    : state_(std::make_unique<State>()) {
  cv::setNumThreads(1);
  State& s = *state_;
  s.kind = kind;
  s.max_hole_px = max_hole_px;
  s.cosine2 = std::cos(hue_threshold) * std::cos(hue_threshold);
  s.steps = static_cast<int>(std::lround(hue_threshold / (2 * M_PI) * 180));
  if (kind == Kind::kSameHue) {
    s.Chroma(ViewOf(background));
    s.bx = s.planes[0].clone();
    s.by3 = 3 * s.planes[1];
    s.reach = s.cosine2 * (s.bx.mul(s.bx) + s.by3.mul(s.planes[1]));
  } else {
    cv::cvtColor(ViewOf(background), s.hsv, cv::COLOR_RGB2HSV);
    cv::extractChannel(s.hsv, s.hue, 0);
    s.hue = s.hue.clone();
  }
}
OpenCvPerson::~OpenCvPerson() = default;
OpenCvPerson::OpenCvPerson(OpenCvPerson&&) noexcept = default;

Mask OpenCvPerson::Find(const ColourImage& picture) {
  State& s = *state_;
  if (s.kind == Kind::kSameHue) {
    // A pixel has changed if the cosine between the chroma vectors of picture and background is below the cosine of the
    // threshold.
    s.Chroma(ViewOf(picture));
    cv::multiply(s.planes[0], s.bx, s.dot);
    cv::accumulateProduct(s.planes[1], s.by3, s.dot);
    cv::multiply(s.planes[0], s.planes[0], s.own);
    cv::multiply(s.planes[1], s.planes[1], s.tmp, 3);
    cv::add(s.own, s.tmp, s.own);
    cv::multiply(s.own, s.reach, s.own);
    cv::compare(s.dot, 0, s.mask, cv::CMP_LE);
    cv::multiply(s.dot, s.dot, s.dot);
    cv::compare(s.dot, s.own, s.buffers.changed, cv::CMP_LT);
    cv::bitwise_or(s.buffers.changed, s.mask, s.buffers.changed);
  } else {
    cv::cvtColor(ViewOf(picture), s.hsv, cv::COLOR_RGB2HSV);
    cv::extractChannel(s.hsv, s.planes[0], 0);
    // A pixel has changed if the hues differ by more than `steps` in both directions of the circle of 180 steps.
    cv::absdiff(s.planes[0], s.hue, s.apart);
    cv::inRange(s.apart, s.steps + 1, 179 - s.steps, s.buffers.changed);
  }
  // Keep the largest piece.
  Mask out(picture.width, picture.height);
  if (s.kind == Kind::kHsvContours) {
    KeepPersonByContours(s.buffers.changed, s.max_hole_px, out);
  } else {
    KeepPersonByLabels(s.buffers.changed, s.max_hole_px, s.buffers, out);
  }
  return out;
}

struct OpenCvModel::State {
  cv::Ptr<cv::BackgroundSubtractor> model;
  int max_hole_px;
  cv::Mat found;
  Buffers buffers;
};

OpenCvModel::OpenCvModel(Kind kind, int max_hole_px) : state_(std::make_unique<State>()) {
  cv::setNumThreads(1);
  state_->max_hole_px = max_hole_px;
  if (kind == Kind::kMog2) {
    state_->model = cv::createBackgroundSubtractorMOG2();
  } else {
    state_->model = cv::createBackgroundSubtractorKNN();
  }
}
OpenCvModel::~OpenCvModel() = default;
OpenCvModel::OpenCvModel(OpenCvModel&&) noexcept = default;

Mask OpenCvModel::Find(const ColourImage& picture) {
  State& s = *state_;
  s.model->apply(ViewOf(picture), s.found);
  cv::threshold(s.found, s.buffers.changed, 200, 255, cv::THRESH_BINARY);  // the value 127 means shadow
  Mask out(picture.width, picture.height);
  KeepPersonByLabels(s.buffers.changed, s.max_hole_px, s.buffers, out);
  return out;
}

}  // namespace etude
