// Matrices between sets of primaries, in double.
#include "io/primaries.hpp"

#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace gll {
namespace {

using Vector3 = std::array<double, 3>;

Vector3 operator*(const Matrix3& m, const Vector3& v) {
    Vector3 result{};
    for (std::size_t i = 0; i < 3; ++i)
        result[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
    return result;
}

Matrix3 operator*(const Matrix3& a, const Matrix3& b) {
    Matrix3 result{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k)
            for (std::size_t j = 0; j < 3; ++j)
                result[i][j] += a[i][k] * b[k][j];
    return result;
}

Matrix3 diagonal(const Vector3& v) { return {{{v[0], 0, 0}, {0, v[1], 0}, {0, 0, v[2]}}}; }

Matrix3 inverse(const Matrix3& m) {
    // Each cofactor's rows and columns follow its own, around the corner, which gives the sign.
    const auto cofactor = [&](std::size_t row, std::size_t column) {
        const std::size_t r1 = (row + 1) % 3, r2 = (row + 2) % 3;
        const std::size_t c1 = (column + 1) % 3, c2 = (column + 2) % 3;
        return m[r1][c1] * m[r2][c2] - m[r1][c2] * m[r2][c1];
    };
    const double determinant = m[0][0] * cofactor(0, 0) + m[0][1] * cofactor(0, 1) + m[0][2] * cofactor(0, 2);
    if (!(std::abs(determinant) > 1e-6)) throw std::invalid_argument("primaries that span no colors");
    Matrix3 result{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            result[i][j] = cofactor(j, i) / determinant;
    return result;
}

// X, Y, Z of the chromaticity for Y = 1.
Vector3 whiteXyz(const std::array<double, 2>& xy) {
    if (!(xy[1] > 1e-6)) throw std::invalid_argument("a white without light");
    return {xy[0] / xy[1], 1, (1 - xy[0] - xy[1]) / xy[1]};
}

const Matrix3 bradford = {{{0.8951, 0.2664, -0.1614}, {-0.7502, 1.7135, 0.0367}, {0.0389, -0.0685, 1.0296}}};

} // namespace

bool nearlyEqual(const Primaries& a, const Primaries& b) {
    const auto near = [](const std::array<double, 2>& p, const std::array<double, 2>& q) {
        return std::abs(p[0] - q[0]) < 0.0005 && std::abs(p[1] - q[1]) < 0.0005;
    };
    return near(a.red, b.red) && near(a.green, b.green) && near(a.blue, b.blue) && near(a.white, b.white);
}

Matrix3 xyzFrom(const Primaries& primaries) {
    Matrix3 columns{};
    std::size_t column = 0;
    for (const auto& xy : {primaries.red, primaries.green, primaries.blue}) {
        columns[0][column] = xy[0];
        columns[1][column] = xy[1];
        columns[2][column] = 1 - xy[0] - xy[1];
        ++column;
    }
    return columns * diagonal(inverse(columns) * whiteXyz(primaries.white));
}

Matrix3 bt709From(const Primaries& primaries) {
    const Vector3 from = bradford * whiteXyz(primaries.white);
    const Vector3 to = bradford * whiteXyz(bt709_primaries.white);
    Vector3 gain{};
    for (std::size_t i = 0; i < 3; ++i) {
        if (!(from[i] > 1e-6)) throw std::invalid_argument("a white that no eye sees");
        gain[i] = to[i] / from[i];
    }
    const Matrix3 adaptation = inverse(bradford) * diagonal(gain) * bradford;
    return inverse(xyzFrom(bt709_primaries)) * adaptation * xyzFrom(primaries);
}

Matrix3 bt709FromXyz() { return inverse(xyzFrom(bt709_primaries)); }

void transform(std::vector<float>& pixels, int channels, const Matrix3& matrix) {
    const auto step = static_cast<std::size_t>(channels);
    for (std::size_t i = 0; i + 2 < pixels.size(); i += step) {
        const Vector3 color = matrix * Vector3{pixels[i], pixels[i + 1], pixels[i + 2]};
        for (std::size_t c = 0; c < 3; ++c)
            pixels[i + c] = static_cast<float>(color[c]);
    }
}

} // namespace gll
