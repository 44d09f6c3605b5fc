#include "sim/random/stream.h"

#include <Random123/philox.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/support/results.h"

namespace etude {
namespace {

const WorldKey kWorld{.suite_seed = 7, .scenario = "test", .trial = 3};

TEST(RandomStream, RestsOnPhiloxWithItsPublishedKnownAnswer) {
  // Random123's kat_vectors: philox 4x64-10, counter and key all ones.
  const std::uint64_t ones = ~std::uint64_t{0};
  const auto block = r123::Philox4x64()({{ones, ones, ones, ones}}, {{ones, ones}});
  EXPECT_EQ(block[0], 0x87b092c3013fe90bULL);
  EXPECT_EQ(block[1], 0x438c3c67be8d0224ULL);
  EXPECT_EQ(block[2], 0x9cc7d7c69cd777b6ULL);
  EXPECT_EQ(block[3], 0xa09caebf594f0ba0ULL);
}

TEST(RandomStream, DependsOnItsKeyAlone) {
  RandomStream a(kWorld, "noise"), b(kWorld, "noise"), other_purpose(kWorld, "noise2");
  RandomStream other_trial({7, "test", 4}, "noise"), other_seed({8, "test", 3}, "noise"),
      other_scenario({7, "tess", 3}, "noise");
  for (int i = 0; i < 100; ++i) {
    const std::uint64_t bits = a.Bits();
    EXPECT_EQ(bits, b.Bits());
    EXPECT_NE(bits, other_purpose.Bits());
    EXPECT_NE(bits, other_trial.Bits());
    EXPECT_NE(bits, other_seed.Bits());
    EXPECT_NE(bits, other_scenario.Bits());
  }
}

/// The key: the bytes of 256 bits in order.
constexpr Words256 kKey = {0x1716151413121110, 0x1f1e1d1c1b1a1918, 0x2726252423222120, 0x2f2e2d2c2b2a2928};

TEST(Seed, CipherIsThreefish256WithItsKnownAnswers) {
  // From the Skein submission (version 1.3): tweak, key and block are zero.
  EXPECT_EQ(Encrypt({}, {}),
            (Words256{0x94eeea8b1f2ada84, 0xadf103313eae6670, 0x952419a1f4b16d53, 0xd83f13e63c9f6b11}));
}

TEST(Seed, IsANumberOrASecretThatTellsItsDigestAlone) {
  const Seed plain = 7, secret = Seed::Secret(kKey);
  EXPECT_EQ(ToString(plain), "7");
  EXPECT_EQ(plain.Public(), 7u);
  EXPECT_EQ(plain.Digest(), "");
  EXPECT_EQ(ToString(secret), "secret " + secret.Digest());
  EXPECT_EQ(secret.Digest().size(), 64u);
  EXPECT_NE(secret.Digest(), Hex(kKey));
  ASSERT_OK(read, ParseSeed(ToString(secret)));
  EXPECT_FALSE(read->IsOpen());
  EXPECT_EQ(*read, secret.WithoutKey());
  EXPECT_EQ(read->Public(), secret.Public());
  EXPECT_LT(secret.Public(), std::uint64_t{1} << 53);
  EXPECT_EQ(ParseSeed("7"), plain);
  for (const char* wrong : {"", "secret", "secret 12", "-1", "1.5", "7 "}) EXPECT_FALSE(ParseSeed(wrong)) << wrong;
  EXPECT_EQ(ParseWords256(Hex(kKey)), kKey);
  EXPECT_FALSE(ParseWords256(Hex(kKey).substr(1)));
}

TEST(Seed, EveryBitOfAKeyCounts) {
  RandomStream stream({Seed::Secret(kKey), "test", 3}, "noise");
  const std::uint64_t first = stream.Bits();
  for (std::size_t bit = 0; bit < 256; ++bit) {
    Words256 other = kKey;
    other[bit / 64] ^= std::uint64_t{1} << (bit % 64);
    const Seed seed = Seed::Secret(other);
    EXPECT_NE(RandomStream({seed, "test", 3}, "noise").Bits(), first);
    EXPECT_NE(seed.Digest(), Seed::Secret(kKey).Digest());
  }
}

TEST(RandomStream, OfASecretSeedDependsOnItsKeyAlone) {
  const Seed secret = Seed::Secret(kKey);
  RandomStream a({secret, "test", 3}, "noise"), b({secret, "test", 3}, "noise");
  RandomStream others[] = {{{secret, "test", 3}, "noise2"},
                           {{secret, "test", 4}, "noise"},
                           {{secret, "tess", 3}, "noise"},
                           {{secret, "test/3", 3}, "noise"},
                           {{secret, "test", 3}, std::string("noise\0", 6)}};
  std::vector<std::uint64_t> filled(103);
  b.FillBits(filled);
  for (const std::uint64_t expected : filled) {
    const std::uint64_t bits = a.Bits();
    EXPECT_EQ(bits, expected);
    for (RandomStream& other : others) EXPECT_NE(bits, other.Bits());
  }
}

TEST(RandomStream, HasTheMomentsOfItsDistributions) {
  RandomStream stream(kWorld, "moments");
  const int n = 200000;
  double uniform_sum = 0, uniform_squares = 0, sum = 0, squares = 0, cubes = 0, fourths = 0;
  for (int i = 0; i < n; ++i) {
    const double u = stream.Uniform();
    ASSERT_GE(u, 0);
    ASSERT_LT(u, 1);
    uniform_sum += u;
    uniform_squares += u * u;
    const double z = stream.Normal();
    sum += z;
    squares += z * z;
    cubes += z * z * z;
    fourths += z * z * z * z;
  }
  // Five standard errors of each moment.
  EXPECT_NEAR(uniform_sum / n, 0.5, 5 * std::sqrt(1.0 / 12 / n));
  EXPECT_NEAR(uniform_squares / n, 1.0 / 3, 5 * std::sqrt(4.0 / 45 / n));
  EXPECT_NEAR(sum / n, 0, 5 / std::sqrt(n));
  EXPECT_NEAR(squares / n, 1, 5 * std::sqrt(2.0 / n));
  EXPECT_NEAR(cubes / n, 0, 5 * std::sqrt(15.0 / n));
  EXPECT_NEAR(fourths / n, 3, 5 * std::sqrt(96.0 / n));
}

TEST(RandomStream, DrawsEveryIndexEquallyOften) {
  RandomStream stream(kWorld, "index");
  std::vector<int> counts(7);
  const int n = 70000;
  for (int i = 0; i < n; ++i) ++counts[stream.IndexBelow(7)];
  double chi_square = 0;
  for (int count : counts) chi_square += (count - 10000.0) * (count - 10000.0) / 10000.0;
  EXPECT_LT(chi_square, 22.46);  // 99.9 % quantile for six degrees of freedom
}

TEST(RandomStream, FillsRowsWithTheBitsThatWouldComeOneByOne) {
  for (const std::size_t before : {0, 1, 2, 3, 4}) {
    RandomStream one_by_one(kWorld, "fill"), filled(kWorld, "fill");
    for (std::size_t i = 0; i < before; ++i) EXPECT_EQ(one_by_one.Bits(), filled.Bits());
    for (const std::size_t count : {0, 1, 3, 4, 11, 384}) {
      std::vector<std::uint64_t> bits(count);
      filled.FillBits(bits);
      for (const std::uint64_t found : bits) ASSERT_EQ(found, one_by_one.Bits());
    }
    EXPECT_EQ(one_by_one.Bits(), filled.Bits());
  }
}

}  // namespace
}  // namespace etude
