#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "engine/boards/printed_board.h"

#if ETUDE_ARUCO_IN_OBJDETECT
#include <opencv2/objdetect/aruco_detector.hpp>
#else
#include <opencv2/aruco.hpp>
#endif

namespace etude {
namespace {

using DictionaryName = decltype(cv::aruco::DICT_4X4_1000);

/// The largest dictionary of each family; OpenCV's smaller dictionaries are the first codes of the largest.
constexpr std::array<std::pair<DictionaryName, const char*>, 9> kDictionaries = {
    {{cv::aruco::DICT_4X4_1000, "DICT_4X4"},
     {cv::aruco::DICT_5X5_1000, "DICT_5X5"},
     {cv::aruco::DICT_6X6_1000, "DICT_6X6"},
     {cv::aruco::DICT_7X7_1000, "DICT_7X7"},
     {cv::aruco::DICT_ARUCO_ORIGINAL, "DICT_ARUCO_ORIGINAL"},
     {cv::aruco::DICT_APRILTAG_16h5, "DICT_APRILTAG_16h5"},
     {cv::aruco::DICT_APRILTAG_25h9, "DICT_APRILTAG_25h9"},
     {cv::aruco::DICT_APRILTAG_36h10, "DICT_APRILTAG_36h10"},
     {cv::aruco::DICT_APRILTAG_36h11, "DICT_APRILTAG_36h11"}}};

using Quad = std::vector<cv::Point2f>;

cv::Mat GrayOf(const ColourImage& picture) {
  cv::Mat colour(picture.height, picture.width, CV_8UC3, const_cast<Rgb8*>(picture.pixels.data()));
  cv::Mat gray;
  cv::cvtColor(colour, gray, cv::COLOR_RGB2GRAY);
  return gray;
}

cv::Point2f Mapped(const cv::Mat& H, double x, double y) {
  const double w = H.at<double>(2, 0) * x + H.at<double>(2, 1) * y + H.at<double>(2, 2);
  return {static_cast<float>((H.at<double>(0, 0) * x + H.at<double>(0, 1) * y + H.at<double>(0, 2)) / w),
          static_cast<float>((H.at<double>(1, 0) * x + H.at<double>(1, 1) * y + H.at<double>(1, 2)) / w)};
}

/// Returns the homography from a marker's square, with corners (±1, ±1), to its quadrilateral in the picture.
cv::Mat HomographyOfQuad(const Quad& quad) {
  const Quad unit = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  return cv::getPerspectiveTransform(unit, quad);
}

/// Detects the markers of one dictionary, including inverted ones.
void DetectMarkers(const cv::Mat& gray, DictionaryName name, std::vector<Quad>& quads, std::vector<int>& ids) {
#if ETUDE_ARUCO_IN_OBJDETECT
  cv::aruco::DetectorParameters parameters;
  parameters.detectInvertedMarker = true;
  cv::aruco::ArucoDetector(cv::aruco::getPredefinedDictionary(name), parameters).detectMarkers(gray, quads, ids);
#else
  const auto parameters = cv::aruco::DetectorParameters::create();
  parameters->detectInvertedMarker = true;
  cv::aruco::detectMarkers(gray, cv::aruco::getPredefinedDictionary(name), quads, ids, parameters);
#endif
}

double Distance(const cv::Point2f& a, const cv::Point2f& b) { return std::hypot(a.x - b.x, a.y - b.y); }

class OpenCvFinder : public PrintedBoardFinder {
 public:
  explicit OpenCvFinder(const PrintedBoard& wanted) : board(wanted) { cv::setNumThreads(1); }
  std::vector<SeenCorner> Find(const ColourImage& picture) override;
  std::string Told() const override;

 private:
  const PrintedBoard board;
  std::array<std::size_t, kDictionaries.size()> votes{};
  std::optional<std::size_t> dictionary;
  /// Number of pictures that show layout 0 (the first marker is in the second square) and layout 1 (in the first
  /// square).
  std::array<std::size_t, 2> layouts{};
  std::map<int, std::size_t> shares;  ///< number of pictures by the ratio of marker side to square side, hundredths
  std::array<std::size_t, 2> inversion{};  ///< number of markers printed black on white (0) and inverted (1)

  std::map<int, Quad> Detect(const cv::Mat& gray, std::size_t which) const {
    std::vector<int> ids;
    std::vector<Quad> quads;
    DetectMarkers(gray, kDictionaries[which].first, quads, ids);
    std::map<int, Quad> markers;
    const int count = board.columns * board.rows / 2 + 1;
    for (std::size_t i = 0; i < ids.size(); ++i) {
      if (ids[i] < count) markers[ids[i]] = quads[i];
    }
    return markers;
  }

  /// Detects markers. All dictionaries are tried until one has clearly the most detections.
  std::map<int, Quad> Markers(const cv::Mat& gray) {
    if (dictionary) return Detect(gray, *dictionary);
    std::map<int, Quad> best;
    for (std::size_t i = 0; i < kDictionaries.size(); ++i) {
      std::map<int, Quad> markers = Detect(gray, i);
      votes[i] += markers.size();
      if (markers.size() > best.size()) best = std::move(markers);
    }
    const auto most = std::ranges::max_element(votes);
    std::size_t others = 0;
    for (const std::size_t vote : votes) others = std::max(others, vote == *most ? 0 : vote);
    constexpr std::size_t kEnough = 20;
    if (*most >= kEnough && *most > 3 * others) dictionary = static_cast<std::size_t>(most - votes.begin());
    return best;
  }

  /// Returns the column and row of the square that holds a marker. In layout 0 the board's second square holds the
  /// first marker, in layout 1 the first square does.
  std::array<int, 2> SquareOf(int id, int layout) const {
    for (int row = 0; row < board.rows; ++row) {
      for (int column = 0; column < board.columns; ++column) {
        if ((column + row) % 2 != (layout == 0 ? 1 : 0)) continue;
        if (id-- == 0) return {column, row};
      }
    }
    return {-1, -1};
  }

  struct Predicted {
    std::array<int, 2> corner;
    cv::Point2f pixel;
    double disagreement = 0;  ///< distance between the two markers' predictions of the corner, in marker sides
    double square_px = 0;
  };

  /// Predicts each corner as the mean of the positions that the corner's two adjacent markers predict. `share` is the
  /// ratio of marker side to square side.
  std::vector<Predicted> Predict(const std::map<int, Quad>& markers, int layout, double share) const {
    // Every marker predicts the four corners of its square.
    std::map<std::array<int, 2>, std::vector<std::pair<cv::Point2f, double>>> predictions;
    for (const auto& [id, quad] : markers) {
      const auto [column, row] = SquareOf(id, layout);
      if (column < 0) continue;
      const cv::Mat H = HomographyOfQuad(quad);
      for (const auto& [dx, dy] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
        const std::array<int, 2> corner = {column + (dx > 0 ? 0 : -1), row + (dy > 0 ? 0 : -1)};
        if (corner[0] < 0 || corner[1] < 0 || corner[0] >= board.columns - 1 || corner[1] >= board.rows - 1) continue;
        predictions[corner].emplace_back(Mapped(H, dx / share, dy / share),
                                         Distance(quad[0], quad[2]) / std::sqrt(2.0));
      }
    }
    // Keep the corners predicted by two markers.
    std::vector<Predicted> predicted;
    for (const auto& [corner, of_corner] : predictions) {
      if (of_corner.size() != 2) continue;
      const double marker = 0.5 * (of_corner[0].second + of_corner[1].second);
      predicted.push_back({corner, 0.5f * (of_corner[0].first + of_corner[1].first),
                           Distance(of_corner[0].first, of_corner[1].first) / marker, marker / share});
    }
    return predicted;
  }

  std::vector<SeenCorner> FindCharuco(const cv::Mat& gray) {
    const std::map<int, Quad> markers = Markers(gray);
    constexpr std::size_t kMinMarkers = 3;
    if (markers.size() < kMinMarkers) return {};
    // Choose the layout and ratio for which the markers agree about the most corners; if several agree about equally
    // many, choose the layout and ratio with the smallest mean disagreement.
    constexpr double kMaxDisagreement = 0.2;
    double min_disagreement = 1e9;
    int layout = 0, share = 75;
    std::vector<Predicted> best;
    for (int way = 0; way < 2; ++way) {
      for (int hundredths = 40; hundredths <= 95; ++hundredths) {
        std::vector<Predicted> predicted = Predict(markers, way, hundredths / 100.0);
        std::erase_if(predicted, [](const Predicted& one) { return one.disagreement > kMaxDisagreement; });
        if (predicted.size() < 2 || predicted.size() < best.size()) continue;
        double sum = 0;
        for (const Predicted& one : predicted) sum += one.disagreement / static_cast<double>(predicted.size());
        if (predicted.size() == best.size() && sum >= min_disagreement) continue;
        min_disagreement = sum;
        layout = way;
        share = hundredths;
        best = std::move(predicted);
      }
    }
    if (best.empty()) return {};
    ++layouts[static_cast<std::size_t>(layout)];
    ++shares[share];
    for (const auto& [id, quad] : markers) CountInversion(gray, quad);
    // Refine the corners in the picture.
    std::vector<SeenCorner> corners;
    for (const Predicted& one : best) {
      Quad refined = {one.pixel};
      const int half = std::clamp(static_cast<int>(0.12 * one.square_px), 2, 12);
      const cv::Rect inside(half + 2, half + 2, gray.cols - 2 * half - 4, gray.rows - 2 * half - 4);
      if (!inside.contains(one.pixel)) continue;
      cv::cornerSubPix(gray, refined, {half, half}, {-1, -1}, Settled());
      if (Distance(refined[0], one.pixel) > half) continue;
      corners.push_back({0, {one.corner[0], one.corner[1]}, {refined[0].x + 0.5, refined[0].y + 0.5}});
    }
    std::ranges::sort(corners, {}, [](const SeenCorner& c) { return std::pair(c.corner.row, c.corner.column); });
    return corners;
  }

  /// Compares the rim of a marker, one module wide, with its surroundings: the rim is darker unless the marker is
  /// inverted.
  void CountInversion(const cv::Mat& gray, const Quad& quad) {
    const cv::Mat H = HomographyOfQuad(quad);
    double rim = 0, outside = 0;
    for (int i = 0; i < 8; ++i) {
      const double along = -0.8 + 0.2 * i;
      for (const auto& [sum, at] : {std::pair(&rim, 0.93), {&outside, 1.12}}) {
        const cv::Point2f p = Mapped(H, along, -at);
        const cv::Point whole(cvRound(p.x), cvRound(p.y));
        if (whole.x >= 0 && whole.y >= 0 && whole.x < gray.cols && whole.y < gray.rows)
          *sum += gray.at<std::uint8_t>(whole);
      }
    }
    ++inversion[rim > outside ? 1 : 0];
  }

  /// Refines the corners of a chessboard by cornerSubPix, with a window of 0.4 times the distance to the nearest
  /// neighbouring corner. This is needed because findChessboardCornersSB leaves errors of 0.1 px, mostly a bias that
  /// all corners share. A corner that would move by more than a pixel, for example in strong blur, keeps its position.
  static void RefineChess(const cv::Mat& gray, const cv::Size& inner, Quad& corners) {
    constexpr double kOfSide = 0.4, kMaxMovePx = 1;
    constexpr int kMinHalf = 2, kMaxHalf = 20;
    const Quad found = corners;
    for (int i = 0; i < inner.width * inner.height; ++i) {
      const cv::Point2f& p = found[static_cast<std::size_t>(i)];
      double side = 1e9;
      for (const auto& [is_there, step] : {std::pair(i % inner.width > 0, -1),
                                           {(i + 1) % inner.width > 0, 1},
                                           {i >= inner.width, -inner.width},
                                           {i + inner.width < inner.width * inner.height, inner.width}}) {
        if (is_there) side = std::min(side, Distance(p, found[static_cast<std::size_t>(i + step)]));
      }
      const int half = std::clamp(static_cast<int>(kOfSide * side), kMinHalf, kMaxHalf);
      const cv::Rect inside(half + 2, half + 2, gray.cols - 2 * half - 4, gray.rows - 2 * half - 4);
      if (!inside.contains(p)) continue;
      Quad refined = {p};
      cv::cornerSubPix(gray, refined, {half, half}, {-1, -1}, Settled());
      if (Distance(refined[0], p) <= kMaxMovePx) corners[static_cast<std::size_t>(i)] = refined[0];
    }
  }

  static cv::TermCriteria Settled() { return {cv::TermCriteria::EPS + cv::TermCriteria::COUNT, 40, 0.01}; }

  std::vector<SeenCorner> FindChess(const cv::Mat& gray) const {
    const cv::Size inner(board.columns - 1, board.rows - 1);
    Quad found;
    if (!cv::findChessboardCornersSB(gray, inner, found, cv::CALIB_CB_NORMALIZE_IMAGE | cv::CALIB_CB_ACCURACY))
      return {};
    RefineChess(gray, inner, found);
    // Orient the board by the colours of its squares.
    const auto at = [&](int column, int row) { return found[static_cast<std::size_t>(row * inner.width + column)]; };
    const auto value = [&](const cv::Point2f& p) {
      const cv::Point whole(std::clamp(cvRound(p.x), 0, gray.cols - 1), std::clamp(cvRound(p.y), 0, gray.rows - 1));
      return static_cast<int>(gray.at<std::uint8_t>(whole));
    };
    // Squares (1, 1) and (2, 1) lie between detected corners; (1, 1) has the colour of the first square.
    const cv::Point2f same = 0.25f * (at(0, 0) + at(1, 0) + at(0, 1) + at(1, 1));
    const cv::Point2f other = 0.25f * (at(1, 0) + at(2, 0) + at(1, 1) + at(2, 1));
    if ((board.columns + board.rows) % 2 != 0 && value(same) > value(other)) std::ranges::reverse(found);
    std::vector<SeenCorner> corners;
    for (int row = 0; row < inner.height; ++row) {
      for (int column = 0; column < inner.width; ++column) {
        const cv::Point2f p = at(column, row);
        corners.push_back({0, {column, row}, {p.x + 0.5, p.y + 0.5}});
      }
    }
    return corners;
  }
};

std::vector<SeenCorner> OpenCvFinder::Find(const ColourImage& picture) {
  const cv::Mat gray = GrayOf(picture);
  try {
    return board.is_charuco ? FindCharuco(gray) : FindChess(gray);
  } catch (const cv::Exception&) {
    return {};  // a picture that OpenCV cannot process shows no board
  }
}

std::string OpenCvFinder::Told() const {
  if (!board.is_charuco) return "a chessboard";
  const auto most = std::ranges::max_element(votes);
  if (*most == 0) return "found no ArUco marker of any dictionary";
  int share = 0;
  std::size_t times = 0;
  for (const auto& [hundredths, count] : shares) {
    if (count > times) share = hundredths;
    times = std::max(times, count);
  }
  return fmt::format("{}{}{}, markers about 0.{:02} of a square",
                     kDictionaries[static_cast<std::size_t>(most - votes.begin())].second,
                     inversion[1] > inversion[0] ? ", inverted" : "",
                     board.rows % 2 == 0 && layouts[1] > layouts[0] ? ", a marker in the first square" : "", share);
}

std::unique_ptr<PrintedBoardFinder> MakeOpenCvFinder(const PrintedBoard& board) {
  return std::make_unique<OpenCvFinder>(board);
}

Result<OpenCvCalibration> CalibrateCamera(std::span<const TargetView> views, const PictureSize& size, LensModel lens) {
  constexpr double kOurPixelCentre = 0.5;
  // Translate the lens model to OpenCV's flags.
  int flags = 0;
  switch (lens) {
    case LensModel::kPinhole:
      flags = cv::CALIB_FIX_K1 | cv::CALIB_FIX_K2 | cv::CALIB_FIX_K3 | cv::CALIB_ZERO_TANGENT_DIST;
      break;
    case LensModel::kRadial2:
      flags = cv::CALIB_FIX_K3;
      break;
    case LensModel::kRadial3:
      break;
    case LensModel::kAsInCamera:
      return Fail({}, "OpenCV's calibrateCamera cannot keep the lens distortion of the given camera");
  }
  // Convert the views; OpenCV's pixel centres are at integers, ours at half-integers.
  std::vector<std::vector<cv::Point3f>> object_points;
  std::vector<Quad> pixels;
  for (const TargetView& view : views) {
    auto& object_view = object_points.emplace_back();
    auto& image_view = pixels.emplace_back();
    for (const PointPair& pair : view.pairs) {
      object_view.emplace_back(static_cast<float>(pair.world.x), static_cast<float>(pair.world.y), 0.0F);
      image_view.emplace_back(static_cast<float>(pair.pixel.x - kOurPixelCentre),
                              static_cast<float>(pair.pixel.y - kOurPixelCentre));
    }
  }
  try {
    cv::setNumThreads(1);
    cv::Mat K, d;
    std::vector<cv::Mat> turns, shifts;
    // Calibrate, and convert the result to our pixel coordinates.
    OpenCvCalibration found;
    constexpr int kSteps = 100;
    constexpr double kSettled = 1e-12;
    found.rms_px = cv::calibrateCamera(object_points, pixels, {size.width, size.height}, K, d, turns, shifts, flags,
                                       {cv::TermCriteria::COUNT + cv::TermCriteria::EPS, kSteps, kSettled});
    found.intrinsics = {size.width,
                        size.height,
                        K.at<double>(0, 0),
                        K.at<double>(1, 1),
                        K.at<double>(0, 2) + kOurPixelCentre,
                        K.at<double>(1, 2) + kOurPixelCentre,
                        0};
    found.distortion = {.k1 = d.at<double>(0),
                        .k2 = d.at<double>(1),
                        .p1 = d.at<double>(2),
                        .p2 = d.at<double>(3),
                        .k3 = d.at<double>(4)};
    return found;
  } catch (const cv::Exception& error) {
    return Fail({}, "OpenCV's calibrateCamera: {}", error.what());
  }
}

}  // namespace
}  // namespace etude

extern "C" __attribute__((visibility("default")))
const etude::OpenCvBoards etude_boards_opencv = {&etude::MakeOpenCvFinder, &etude::CalibrateCamera};
