// Golden values of whole results over random pictures: whatever changes a pixel or a coordinate is noticed. What is
// right is said by the tests beside.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/vision/background_estimate.h"
#include "engine/vision/components.h"
#include "engine/vision/limb_colours.h"
#include "engine/vision/person_finder.h"
#include "tests/support/fingerprint.h"

namespace etude {
namespace {

using testing::Fingerprint;

std::uint8_t LevelFrom(double level) { return static_cast<std::uint8_t>(std::clamp(level, 0.0, 255.0)); }

/// `colour` in some light, with noise of so many levels.
Rgb8 Noisy(testing::Dice& dice, Rgb8 colour, double light, double noise) {
  const auto seen = [&](int level) { return LevelFrom(level * light + noise * dice.Signed() + 0.5); };
  const std::uint8_t r = seen(colour.r), g = seen(colour.g);
  return {r, g, seen(colour.b)};
}

Fingerprint& AddPicture(Fingerprint& print, const ColourImage& picture) {
  for (const Rgb8& p : picture.pixels) print.Add(p.r).Add(p.g).Add(p.b);
  return print.Add(picture.width);
}

template <typename Point>
void AddEnds(Fingerprint& print, const Point& segment) {
  print.Add(segment.has_value());
  if (segment) print.Add(segment->a).Add(segment->b);
}

void AddMarks(Fingerprint& print, const Marks& marks) {
  for (const auto& stroke : marks.strokes) AddEnds(print, stroke);
  print.Add(marks.effectors);
}

void AddRegion(Fingerprint& print, const Region& region) {
  for (const PixelRun& run : region.runs) print.Add(run.y).Add(run.x0).Add(run.x1);
  print.Add(region.pixels).Add(region.middle).Add(region.is_cut).Add(region.contrast);
}

void AddEvidence(Fingerprint& print, const PictureEvidence& seen) {
  for (const auto& limb : seen.limbs) {
    print.Add(limb.has_value());
    if (!limb) continue;
    print.Add(limb->line.a).Add(limb->line.b).Add(limb->seen_share).Add(limb->contrast).Add(limb->half_width);
  }
  print.Add(seen.joints);
}

/// Every pixel centre of the picture within `radius` of the segment; with flat ends none before a or behind b.
template <typename Put>
void Draw(int width, int height, const glm::dvec2& a, const glm::dvec2& b, double radius, bool is_flat, Put put) {
  const glm::dvec2 along = b - a, low = glm::min(a, b) - radius - 1.0, high = glm::max(a, b) + radius + 1.0;
  for (int y = std::max(0, static_cast<int>(low.y)); y < std::min<double>(height, high.y); ++y) {
    for (int x = std::max(0, static_cast<int>(low.x)); x < std::min<double>(width, high.x); ++x) {
      const glm::dvec2 p(x + 0.5, y + 0.5);
      const double share = glm::dot(p - a, along) / glm::dot(along, along);
      if (is_flat && (share < 0 || share > 1)) continue;
      if (glm::distance(p, a + std::clamp(share, 0.0, 1.0) * along) < radius) put(x, y, share);
    }
  }
}

/// Colours of a circle of hues a fourteenth apart.
LimbColours SuitOfHues() {
  const auto hue = [](std::size_t i) {
    const auto channel = [&](double from) {
      const double off = std::abs(std::remainder(360.0 / 14 * static_cast<double>(5 * i % 14) - from, 360.0));
      return LevelFrom(200 * std::clamp(2 - off / 60, 0.0, 1.0));
    };
    return Rgb8{channel(0), channel(120), channel(240)};
  };
  LimbColours suit{.trunk = hue(0), .limbs = {}};
  for (std::size_t i = 0; i < kStrokeCount; ++i) suit.limbs[i] = hue(i + 1);
  return suit;
}

struct SuitPicture {
  ColourImage picture{119, 142, {90, 90, 90}};
  Mask person{119, 142};
};

/// Somebody in a suit, in any pose and anywhere in the picture, of limbs that cover each other in any order, are
/// thinner or thicker, and of which some are not there; noise, spots of their colours, and a frayed mask.
SuitPicture AnyoneInSuit(testing::Dice& dice, bool is_flat) {
  SuitPicture made;
  const LimbColours suit = SuitOfHues();
  const glm::dvec2 hip = glm::dvec2(60, 75) + 30.0 * glm::dvec2{dice.Signed(), dice.Signed()};
  const glm::dvec2 up = glm::normalize(glm::dvec2(0.3 * dice.Signed(), -1)), aside(-up.y, up.x), neck = hip + 38.0 * up;
  struct Part {
    glm::dvec2 a, b;
    double radius;
    Rgb8 colour;
  };
  std::vector<Part> parts = {{hip, neck, 10 + 3 * dice.Signed(), suit.trunk}};
  const double size = 1 + 0.3 * dice.Signed();
  for (std::size_t chain = 0; chain < 5; ++chain) {
    const bool is_arm = chain / 2 == 1;
    glm::dvec2 from = chain == 4 ? neck : (is_arm ? neck : hip) + (chain % 2 ? 8.0 : -8.0) * aside;
    for (std::size_t i = 3 * chain; i < std::min(3 * chain + 3, kStrokeCount); ++i) {
      const double length = size * (chain == 4 ? 8 : i % 3 == 2 ? 11 : is_arm ? 18 : 25);
      const double radius = size * (chain == 4 ? 7 : 5.5 - 0.9 * (i % 3) - is_arm) + dice.Signed();
      const glm::dvec2 out = chain == 4 ? up : glm::dvec2{dice.Signed(), is_arm ? dice.Signed() : 1.0};
      const glm::dvec2 to = from + length * (0.55 + 0.45 * dice.Signed()) * glm::normalize(out);
      if (dice.Below(12) != 0) parts.push_back({from, to, radius, suit.limbs[i]});
      from = to;
    }
  }
  for (std::size_t i = parts.size(); i-- > 1;) std::swap(parts[i], parts[dice.Below(i + 1)]);
  for (const Part& part : parts) {
    Draw(made.picture.width, made.picture.height, part.a, part.b, part.radius, is_flat, [&](int x, int y, double) {
      made.picture.At(x, y) = Noisy(dice, part.colour, 0.7 + 0.003 * x, 9);
      made.person.At(x, y) = dice.Below(9) != 0;
    });
  }
  for (int spot = 0; spot < 6; ++spot) {
    const int width = 4 + static_cast<int>(dice.Below(4)), height = 4 + static_cast<int>(dice.Below(4));
    const int left = static_cast<int>(dice.Below(119 - width)), top = static_cast<int>(dice.Below(142 - height));
    const Rgb8 colour = spot == 0 ? suit.trunk : suit.limbs[dice.Below(kStrokeCount)];
    for (int y = top; y < top + height; ++y) {
      for (int x = left; x < left + width; ++x) made.picture.At(x, y) = colour, made.person.At(x, y) = 1;
    }
  }
  return made;
}

TEST(VisionGolden, LimbsOfColouredSuits) {
  testing::Dice dice(3);
  const LimbColours suit = SuitOfHues();
  Fingerprint regions, evidence, marks, spoilt;
  for (int k = 0; k < 150; ++k) {
    LimbColourOptions options;
    const bool is_flat = k % 2;
    if (is_flat) options.look = {.figure = FigureKind::kDressed, .head_below_crown = 1.1};
    if (k % 5 == 1) options.margin_px = 1, options.reach = 0.06, options.darkest = 150;
    if (k % 5 == 2) options.piece_share = 0.6, options.smallest_piece = 45, options.least_side_px = 2;
    if (k % 5 == 3) options.seam_px = 0, options.margin_px = 0, options.piece_share = 0, options.smallest_piece = 6;
    const SuitPicture made = AnyoneInSuit(dice, is_flat);
    LimbRegions found = FindColouredLimbs(made.picture, made.person, suit, options);
    regions.Add(found.width).Add(found.height);
    AddRegion(regions, found.trunk);
    for (std::size_t i = 0; i < kStrokeCount; ++i) {
      AddRegion(regions, found.limbs[i]);
      regions.Add(found.borders[i]);
      found.limbs[i].contrast = 10 + 5 * dice.Signed();
    }
    AddEvidence(evidence, FindLimbEvidence(found, options.look));
    AddMarks(marks, ReadLimbColours(made.picture, made.person, suit, options));
    // What others do not tell: limbs, borders and the trunk that are not seen.
    for (int variant = 0; variant < 4; ++variant) {
      LimbRegions less = found;
      for (std::size_t i = 0; i < kStrokeCount; ++i) {
        if (dice.Below(3) == 0) less.borders[i].clear();
        if (dice.Below(4) == 0) less.limbs[i] = {};
        if (dice.Below(4) == 0) less.borders[i].resize(std::min<std::size_t>(less.borders[i].size(), dice.Below(6)));
      }
      if (variant % 2) less.trunk = {};
      AddEvidence(spoilt, FindLimbEvidence(less, options.look));
    }
  }
  EXPECT_TRUE(regions.Is(107620, -3295.10713449));
  EXPECT_TRUE(evidence.Is(13976, -3365.48322608));
  EXPECT_TRUE(marks.Is(7342, 1422.62172584));
  EXPECT_TRUE(spoilt.Is(39766, 12073.6853637));
}

Region Rectangle(int left, int top, int width, int height, int step) {
  Region region;
  for (int y = 0; y < height; ++y) {
    const int x = left + step * y;
    region.runs.push_back({top + y, x, x + width});
    region.middle += glm::dvec2(x + 0.5 * width, top + y + 0.5) / static_cast<double>(height);
  }
  region.pixels = width * height;
  return region;
}

TEST(VisionGolden, LinesOfRectanglesOfEverySize) {
  Fingerprint print;
  for (int step = -1; step <= 1; ++step) {
    for (int width = 1; width < 14; ++width) {
      for (int height = 1; height < 17; ++height) {
        const MiddleLine line = FindMiddleLine(Rectangle(3, 5, width, height, step));
        print.Add(line.origin).Add(glm::abs(line.along)).Add(line.high - line.low).Add(line.half_width);
        print.Add(line.IsLong());
      }
    }
  }
  EXPECT_TRUE(print.Is(4368, 632.688118095));
}

/// Limbs of a few pixels, whose borders have a few sides: about every threshold.
TEST(VisionGolden, EvidenceOfSmallRectangles) {
  testing::Dice dice(8);
  Fingerprint print;
  for (int k = 0; k < 600; ++k) {
    LimbRegions regions{.width = 50, .height = 60, .trunk = {}, .limbs = {}, .borders = {}};
    if (k % 4) regions.trunk = k % 8 == 1 ? Rectangle(20, 20, 1, 1, 0) : Rectangle(20, 20, 8, 14, 0);
    for (std::size_t i = 0; i < kStrokeCount; ++i) {
      const auto below = [&](int limit) { return static_cast<int>(dice.Below(limit)); };
      if (below(5) == 0) continue;
      const int width = 1 + below(5), height = 1 + below(10), left = below(50 - width), top = below(60 - height);
      regions.limbs[i] = Rectangle(left, top, width, height, 0);
      regions.limbs[i].is_cut = left == 0 || top == 0 || left + width == 50 || top + height == 60;
      const int sides = below(7), y = top + (below(2) ? 0 : height);
      for (int s = 0; s < sides; ++s) regions.borders[i].push_back({left + 0.5 + s, y + 0.5 * below(2)});
    }
    AddEvidence(print, FindLimbEvidence(regions, {.figure = k % 3 ? FigureKind::kDressed : FigureKind::kCapsules}));
  }
  EXPECT_TRUE(print.Is(55577, 302.926400983));
}

TEST(VisionGolden, MarksThatCoverEachOther) {
  testing::Dice dice(5);
  Fingerprint print;
  for (int k = 0; k < 150; ++k) {
    ColourImage picture(61 + k % 9, 47);
    const auto anywhere = [&] { return glm::dvec2(35, 23) + glm::dvec2(40, 28) * glm::dvec2(dice.Vector()); };
    for (const StrokeMark& mark : StrokeMarks()) {
      if (dice.Below(3) == 0) continue;
      const double share_drawn = dice.Below(4) == 0 ? 0.1 : 0.6;
      const glm::dvec2 a = anywhere(), b = a + share_drawn * (anywhere() - a);
      Draw(picture.width, picture.height, a, b, kStrokeWidth / 2, false,
           [&](int x, int y, double share) { picture.At(x, y) = share < 0.5 ? mark.first_half : mark.second_half; });
    }
    for (const EffectorMark& mark : EffectorMarks()) {
      if (dice.Below(6) == 0) continue;
      const glm::dvec2 at = anywhere();
      Draw(picture.width, picture.height, at, at + 1e-9, kDiscRadius, false,
           [&](int x, int y, double) { picture.At(x, y) = mark.colour; });
    }
    AddMarks(print, ReadMarks(picture));
  }
  EXPECT_TRUE(print.Is(8324, 998.257355802));
}

/// Colours in steps of fifteen levels, so that many lie exactly at a threshold.
Rgb8 InSteps(testing::Dice& dice) {
  const auto level = [&] { return static_cast<std::uint8_t>(15 * dice.Below(18)); };
  const std::uint8_t r = level(), g = level();
  return {r, g, level()};
}

TEST(VisionGolden, ChangeAsEverySegmenterSeesIt) {
  testing::Dice dice(2);
  ColourImage room(83, 61), picture(83, 61);
  for (std::size_t i = 0; i < room.pixels.size(); ++i) {
    room.pixels[i] = i % 19 == 0 ? Rgb8{} : InSteps(dice);
    picture.pixels[i] = i % 38 == 0  ? Rgb8{0, static_cast<std::uint8_t>(i % 4 * 5), 0}
                        : i % 3 == 0 ? InSteps(dice)
                                     : Noisy(dice, room.pixels[i], 0.9 + 0.5 * dice.Signed(), 30);
    if (i % 3 == 1) {
      for (std::uint8_t Rgb8::*c : {&Rgb8::r, &Rgb8::g, &Rgb8::b})
        picture.pixels[i].*c = static_cast<std::uint8_t>(picture.pixels[i].*c / 15 * 15);
    }
  }
  const ChangeOptions even{.hue_threshold = Radians(45),
                           .min_saturation = 0.25,
                           .min_chroma = 15,
                           .saturation_threshold = 0.25,
                           .darkest_shadow = 0.5,
                           .brightest_light = 1.5,
                           .rgb_threshold = 30,
                           .ratio_threshold = 30};
  Fingerprint print;
  for (const Segmenter segmenter : {Segmenter::kRgb, Segmenter::kHue, Segmenter::kHueGated, Segmenter::kRatio}) {
    for (const ChangeOptions& options : {ChangeOptions(), even}) {
      print.Add(DetectChange(room, picture, segmenter, options).pixels);
      for (const PersonPieces pieces : {PersonPieces::kLargest, PersonPieces::kLarge}) {
        PersonOptions person{.segmenter = segmenter, .change = options, .pieces = pieces};
        print.Add(ExtractPerson(room, picture, person).pixels);
        person.smallest_piece = 3, person.piece_reach = 9, person.largest_hole = 2;
        print.Add(ExtractPerson(room, picture, person).pixels);
        print.Add(PersonFinder(room, person).Find(picture).pixels);
      }
    }
  }
  EXPECT_TRUE(print.Is(283584, -6355.00564021));
  Fingerprint colours;
  for (const std::string& name : SegmenterNames()) colours.Add(name).Add(SegmenterNamed(name));
  for (int i = 0; i < 2000; ++i) {
    const Hsi hsi = ToHsi(InSteps(dice));
    colours.Add(hsi.hue).Add(hsi.saturation).Add(hsi.intensity);
  }
  EXPECT_TRUE(colours.Is(6049, 1212.84313915));
}

/// Somebody of many colours, some of them the room's, crosses a room in a light that drifts, with a shadow beside.
std::vector<ColourImage> WalkThrough(testing::Dice& dice, const ColourImage& room, int frames, int pixels) {
  std::vector<ColourImage> film;
  for (int k = 0; k < frames; ++k) {
    ColourImage& picture = film.emplace_back(room);
    for (int y = 0; y < room.height; ++y) {
      for (int x = 0; x < room.width; ++x) {
        const int left = pixels * k - 8;
        const int top = pixels == 5 ? 0 : 6, bottom = pixels == 5 ? room.height : 55;
        const bool is_person = x >= left && x < left + 26 - y / 5 && y >= top && y < bottom;
        const Rgb8 worn = y < 25 ? Rgb8{LevelFrom(110 + 2 * y), 95, LevelFrom(70 + 3 * (x - left))}
                                 : Rgb8{50, LevelFrom(130 - y), LevelFrom(40 + 2 * y)};
        const double light = (1 + 0.01 * k) * (!is_person && y > 50 && x > left && x < left + 40 ? 0.4 + 0.005 * x : 1);
        picture.At(x, y) = Noisy(dice, is_person ? worn : room.At(x, y), light, 3);
      }
    }
  }
  return film;
}

TEST(VisionGolden, PeopleInFilms) {
  testing::Dice dice(4);
  ColourImage room(97, 61);
  for (int y = 0; y < room.height; ++y) {
    for (int x = 0; x < room.width; ++x) {
      room.At(x, y) =
          Noisy(dice, x < 40 ? Rgb8{LevelFrom(90 + 2 * x), 100, 130} : Rgb8{150, LevelFrom(90 + y), 60}, 1, 9);
    }
  }
  Fingerprint print;
  for (const int pixels : {1, 5, 22}) {
    const std::vector<ColourImage> film = WalkThrough(dice, room, 18, pixels);
    for (const auto& [segmenter, options] :
         {std::pair(Segmenter::kRunning, ChangeOptions()),
          {Segmenter::kRunning, {.learning_rate = 0.2, .running_deviations = 2.5, .least_deviation = 2}},
          {Segmenter::kLikelihood, {}},
          {Segmenter::kRatio, {}}}) {
      PersonFinder finder(room, {.segmenter = segmenter, .change = options, .pieces = PersonPieces::kLarge});
      for (const ColourImage& picture : film) print.Add(finder.Find(picture).pixels);
      for (const ColourImage& picture : film) print.Add(finder.Detect(picture).pixels);
    }
  }
  EXPECT_TRUE(print.Is(2556576, 47936.2550096));
}

TEST(VisionGolden, RoomsBehindWhatMoves) {
  testing::Dice dice(6);
  std::vector<ColourImage> pictures;
  for (int k = 0; k < 9; ++k) {
    ColourImage& picture = pictures.emplace_back(23, 17);
    for (int i = 0; i < 23 * 17; ++i) {
      const int shown = (i / 5 + k) % 7 < 3 ? 60 + k : 140;
      picture.pixels[i] = Noisy(dice, {LevelFrom(shown), 100, LevelFrom(200 - shown)}, 1, 6);
    }
  }
  Fingerprint print;
  for (const MotionOptions& options : {MotionOptions(), {.lag = 2, .reach = 3, .change = 5}, {.lag = 20, .reach = 0}}) {
    const std::vector<Activity> motion = MotionActivity(pictures, options);
    for (const Activity& activity : motion) print.Add(activity.pixels);
    for (const std::size_t kept : {1, 2, 3, 6, 9, 10}) AddPicture(print, EstimateBackground(pictures, motion, kept));
  }
  AddPicture(print, EstimateBackground(std::span(pictures).first(1), MotionActivity(std::span(pictures).first(1)), 1));
  EXPECT_TRUE(print.Is(32890, 2736.21633096));
}

TEST(VisionGolden, PiecesOfMasksOfEverySize) {
  testing::Dice dice(7);
  Fingerprint print;
  for (const auto& [width, height] : {std::pair(1, 1), {1, 9}, {9, 1}, {5, 4}, {16, 7}, {17, 13}, {40, 23}}) {
    for (const int share : {1, 3, 5, 7, 9, 10}) {
      Mask mask(width, height);
      for (std::uint8_t& pixel : mask.pixels) pixel = dice.Below(10) < static_cast<std::uint32_t>(share);
      for (const Connectivity connectivity : {Connectivity::kFour, Connectivity::kEight}) {
        const Components found = LabelComponents(mask, connectivity);
        for (const Components::Run& run : found.runs) print.Add(run.row).Add(run.begin).Add(run.end).Add(run.piece);
        for (const Components::Piece& piece : found.pieces)
          print.Add(piece.set).Add(piece.size).Add(piece.touches_border);
      }
      print.Add(LargestComponent(mask).pixels);
      for (int k = 0; k < 5; ++k) {
        print.Add(LargeComponents(mask, 1 + k, k).pixels).Add(FillHoles(mask, k).pixels);
        Mask kept = mask;
        KeepPerson(kept, k);
        print.Add(kept.pixels);
      }
    }
  }
  EXPECT_TRUE(print.Is(148346, -1742.87575684));
}

}  // namespace
}  // namespace etude
