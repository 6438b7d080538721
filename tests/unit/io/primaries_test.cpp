// The matrices between primaries against published ones.
#include "io/primaries.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

using namespace gll;

namespace {

void expectNear(const Matrix3& matrix, const Matrix3& expected, double tolerance) {
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            EXPECT_NEAR(matrix[i][j], expected[i][j], tolerance) << i << ", " << j;
}

constexpr Matrix3 identity = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

} // namespace

TEST(Primaries, Bt709HasTheMatricesOfItsStandard) {
    // IEC 61966-2-1, rounded there to four places.
    expectNear(xyzFrom(bt709_primaries),
               {{{0.4124, 0.3576, 0.1805}, {0.2126, 0.7152, 0.0722}, {0.0193, 0.1192, 0.9505}}}, 6e-5);
    expectNear(bt709From(bt709_primaries), identity, 1e-12);
    expectNear(bt709FromXyz(),
               {{{3.2406, -1.5372, -0.4986}, {-0.9689, 1.8758, 0.0415}, {0.0557, -0.2040, 1.0570}}}, 4e-4);
}

TEST(Primaries, AcesIsAdaptedByBradford) {
    // From AP0 (SMPTE ST 2065-1) to BT.709 with D65, as the Academy's CTL and OpenColorIO have it.
    const Primaries ap0 = {{0.7347, 0.2653}, {0, 1}, {0.0001, -0.077}, {0.32168, 0.33767}};
    expectNear(
        bt709From(ap0),
        {{{2.52169, -1.13413, -0.38756}, {-0.27648, 1.37272, -0.09624}, {-0.01538, -0.15298, 1.16835}}},
        5e-5);
}

TEST(Primaries, WhatIsWhiteStaysWhite) {
    const Matrix3 matrix = bt709From({{0.6, 0.35}, {0.25, 0.55}, {0.2, 0.1}, {0.4, 0.38}});
    for (const auto& row : matrix)
        EXPECT_NEAR(row[0] + row[1] + row[2], 1, 1e-12);
}

TEST(Primaries, OnesThatSpanNoColorsAreRefused) {
    EXPECT_THROW(bt709From({{0.3, 0.3}, {0.3, 0.3}, {0.15, 0.06}, {0.3127, 0.329}}), std::invalid_argument);
    EXPECT_THROW(bt709From({{0.64, 0.33}, {0.3, 0.6}, {0.15, 0.06}, {0.3127, 0}}), std::invalid_argument);
    EXPECT_THROW(bt709From({{0.64, 0.33}, {0.3, 0.6}, {0.15, 0.06}, {2, 0.1}}), std::invalid_argument);
}

TEST(Primaries, OnlyTheFirstThreeChannelsAreColors) {
    std::vector<float> pixels = {1, 2, 3, 0.5F, 4, 5, 6, 0.25F};
    transform(pixels, 4, {{{0, 1, 0}, {0, 0, 1}, {2, 0, 0}}});
    EXPECT_EQ(pixels, (std::vector<float>{2, 3, 2, 0.5F, 5, 6, 8, 0.25F}));
}
