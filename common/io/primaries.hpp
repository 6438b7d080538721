// The colors that R, G and B stand for, and the way from them to the ones that everything here works in.
#pragma once

#include <array>
#include <vector>

namespace gll {

// CIE 1931 chromaticities x, y of the primaries and of the white that R = G = B makes.
struct Primaries {
    std::array<double, 2> red, green, blue, white;
};

inline constexpr Primaries bt709_primaries = {{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, {0.3127, 0.3290}};

// Numbers that are CIE XYZ itself, as an EXR marks them.
inline constexpr Primaries xyz_primaries = {{1, 0}, {0, 1}, {0, 0}, {1.0 / 3, 1.0 / 3}};

using Matrix3 = std::array<std::array<double, 3>, 3>; // rows

// Whether they are the same to 0.0005 in each coordinate: files round them.
bool nearlyEqual(const Primaries& a, const Primaries& b);

// From linear RGB to CIE XYZ with Y = 1 for white (SMPTE RP 177). Throws std::invalid_argument where the
// primaries span no colors.
Matrix3 xyzFrom(const Primaries& primaries);

// From linear RGB of these primaries to that of BT.709, the white adapted by Bradford (Lam 1985, as in
// ICC.1:2022 annex E): what was white stays white. Throws as xyzFrom.
Matrix3 bt709From(const Primaries& primaries);

// From CIE XYZ to linear RGB of BT.709, whose white is D65: no white is adapted, as XYZ has none of its own.
Matrix3 bt709FromXyz();

// The first three of each pixel's channels, through the matrix. There must be three at least.
void transform(std::vector<float>& pixels, int channels, const Matrix3& matrix);

} // namespace gll
