// A tileable red brick wall in running bond: a height field first, everything else follows from it.
// Lengths are in tiles (the picture is one tile wide); all noise repeats after one tile.
#include "assets.hpp"
#include "files.hpp"
#include "noise.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <stdexcept>

namespace bake {
namespace {

constexpr int resolution = 1024;
constexpr int bricks_across = 4;
constexpr int courses = 12; // even, so that the half-brick shift of every other course repeats too
constexpr double course_height = 1.0 / courses;
constexpr double brick_pitch = 1.0 / bricks_across;
constexpr double half_joint = 0.0062;

using glm::dvec2;
using glm::dvec3;

/// Octaves of noise over the tile with a whole number of lattice cells across it.
double tiled(const dvec2& uv, int cells, int octaves, std::uint32_t seed, double gain = 0.5) {
    const glm::ivec3 period{cells, cells, 0};
    return fractalNoise({uv * static_cast<double>(cells), 0.5}, octaves, seed, gain, period);
}

struct Wall {
    double height;             ///< above the joint's bed, tiles
    double brick;              ///< 1 on brick, 0 on mortar
    double inside;             ///< distance to the brick's edge, positive on it
    double chip;               ///< 1 where a piece broke off
    std::array<double, 4> lot; ///< four numbers in [0, 1) that belong to this brick
};

Wall wall(const dvec2& uv) {
    // Hand-laid: nothing is quite straight.
    const dvec2 bent = uv + 0.0022 * dvec2{tiled(uv, 6, 3, 3), tiled(uv, 6, 3, 5)} +
                       0.0016 * dvec2{tiled(uv, 40, 3, 7), tiled(uv, 40, 3, 9)};
    const int course = static_cast<int>(std::floor(bent.y * courses));
    const int course_id = ((course % courses) + courses) % courses;
    const double shifted = bent.x * bricks_across + (course_id % 2 == 0 ? 0.0 : 0.5);
    const int column = static_cast<int>(std::floor(shifted));
    const int column_id = ((column % bricks_across) + bricks_across) % bricks_across;
    Wall w{};
    for (std::size_t k = 0; k < w.lot.size(); ++k) {
        w.lot[k] = hashUnit(column_id, course_id, static_cast<int>(k), 101);
    }
    // From the brick's middle, in tiles; each brick is a little turned and a little smaller than its place.
    dvec2 local{(shifted - column - 0.5) * brick_pitch, (bent.y * courses - course - 0.5) * course_height};
    const double turn = 0.020 * (w.lot[0] - 0.5);
    local = {local.x - turn * local.y, local.y + turn * local.x};
    const dvec2 half{0.5 * brick_pitch - half_joint - 0.0030 * w.lot[1],
                     0.5 * course_height - half_joint - 0.0022 * w.lot[2]};
    constexpr double corner = 0.0060;
    const dvec2 beyond = glm::abs(local) - half + corner;
    const double box =
        glm::length(glm::max(beyond, dvec2{0.0})) + std::min(std::max(beyond.x, beyond.y), 0.0) - corner;
    // Edges crumble at two sizes; now and then a bigger piece is gone.
    const double crumble = 0.0016 * tiled(uv, 64, 3, 13) + 0.0010 * tiled(uv, 160, 2, 17);
    const double piece = smoothStep(0.12, 0.42, tiled(uv, 26, 3, 19, 0.55)) * smoothStep(0.020, 0.0, -box);
    w.chip = piece;
    w.inside = -(box + crumble + 0.0075 * piece);
    w.brick = smoothStep(-0.0010, 0.0016, w.inside);

    const double sand = 0.00075 * tiled(uv, 110, 3, 23, 0.7) + 0.00050 * tiled(uv, 30, 2, 29);
    const double mortar = 0.0006 + sand + 0.0011 * smoothStep(-0.007, 0.0, w.inside);
    const double shoulder = smoothStep(-0.0012, 0.0046, w.inside);
    const CellNoise pit = cellNoise({uv * 90.0, 0.5}, 31, {90, 90, 0});
    const double pit_size = pit.id < 0.25 ? 0.15 + 1.0 * pit.id : 0.0;
    const double pits = pit_size > 0.0 ? 1.0 - smoothStep(0.4 * pit_size, pit_size, pit.nearest) : 0.0;
    const double crease = std::abs(tiled(uv, 9, 4, 37));
    const double crack = (w.lot[3] > 0.72 ? 1.0 : 0.0) * (1.0 - smoothStep(0.0, 0.014, crease)) *
                         smoothStep(0.0, 0.02, w.inside);
    const double face = 0.0058 + 0.0016 * (w.lot[2] - 0.5) + 0.006 * (w.lot[3] - 0.5) * local.x * 4.0 +
                        0.0011 * tiled(uv, 20, 3, 41) + 0.00055 * tiled(uv, 90, 3, 43, 0.6) - 0.0011 * pits -
                        0.0014 * crack - 0.0012 * piece;
    w.height = mortar + (std::max(face, mortar) - mortar) * shoulder;
    return w;
}

dvec3 brickColor(const Wall& w, const dvec2& uv) {
    // Linear BT.709, from a kiln's range: orange where it burned cool, purple brown where it burned hot.
    static constexpr std::array<dvec3, 5> kiln{{{0.400, 0.135, 0.072},
                                                {0.335, 0.098, 0.055},
                                                {0.270, 0.076, 0.048},
                                                {0.345, 0.140, 0.088},
                                                {0.185, 0.062, 0.047}}};
    const double place = w.lot[0] * (static_cast<double>(kiln.size()) - 1.001);
    const auto i = static_cast<std::size_t>(place);
    dvec3 color = glm::mix(kiln[i], kiln[i + 1], place - static_cast<double>(i));
    color *= 0.84 + 0.34 * w.lot[1];
    const double cloud = tiled(uv, 14, 4, 47, 0.6);
    const double grit = tiled(uv, 120, 3, 53, 0.7);
    color *= 1.0 + 0.42 * cloud + 0.30 * grit;
    // Scorched flanks on some bricks.
    color *= 1.0 - 0.50 * smoothStep(0.05, 0.42, tiled(uv, 11, 3, 59) + 0.5 * (w.lot[2] - 0.6));
    // Fresh clay where it broke, sand baked into the face elsewhere.
    color = glm::mix(color, dvec3{0.430, 0.205, 0.125} * (1.0 + 0.5 * grit), 0.55 * w.chip);
    const CellNoise grain = cellNoise({uv * 170.0, 0.5}, 61, {170, 170, 0});
    if (grain.id < 0.10)
        color = glm::mix(color, dvec3{0.52, 0.42, 0.33}, 0.5 * (1.0 - smoothStep(0.15, 0.35, grain.nearest)));
    if (grain.id > 0.93) color *= 1.0 - 0.6 * (1.0 - smoothStep(0.15, 0.35, grain.nearest));
    // A veil of lime near the joints.
    const double veil =
        smoothStep(0.05, 0.40, tiled(uv, 8, 4, 67)) * (0.35 + 0.65 * smoothStep(0.02, 0.0, w.inside));
    return glm::mix(color, dvec3{0.46, 0.38, 0.33}, 0.34 * veil);
}

dvec3 mortarColor(const dvec2& uv) {
    const double tone = 0.18 * tiled(uv, 7, 4, 71) + 0.34 * tiled(uv, 130, 3, 73, 0.75);
    dvec3 color = dvec3{0.440, 0.405, 0.350} * (1.0 + tone);
    const CellNoise grain = cellNoise({uv * 200.0, 0.5}, 79, {200, 200, 0});
    if (grain.id < 0.14) color *= 1.0 - 0.45 * (1.0 - smoothStep(0.2, 0.4, grain.nearest));
    return color;
}

/// A square field that repeats.
class Field {
  public:
    double& operator()(int x, int y) { return values_[index(x, y)]; }
    double operator()(int x, int y) const { return values_[index(x, y)]; }

  private:
    static std::size_t index(int x, int y) {
        constexpr auto n = static_cast<unsigned>(resolution); // a power of two: the mask wraps negatives too
        return (static_cast<unsigned>(y) & (n - 1)) * n + (static_cast<unsigned>(x) & (n - 1));
    }
    std::vector<double> values_ = std::vector<double>(static_cast<std::size_t>(resolution) * resolution);
};
static_assert((resolution & (resolution - 1)) == 0);

/// Share of the sky a texel sees over its own field: per direction, 1 - sin(highest elevation), averaged
/// (Bavoil, Sainz and Dimitrov, "Image-Space Horizon-Based Ambient Occlusion", SIGGRAPH 2008 talks).
double openness(const Field& height, int x, int y) {
    constexpr int directions = 12;
    constexpr double exaggeration = 1.5;
    double sum = 0.0;
    for (int d = 0; d < directions; ++d) {
        const double angle_rad = 2.0 * std::numbers::pi * (d + 0.5) / directions;
        double slope = 0.0;
        for (const int reach : {1, 2, 3, 5, 8, 12, 18, 27}) {
            const int dx = static_cast<int>(std::lround(reach * std::cos(angle_rad)));
            const int dy = static_cast<int>(std::lround(reach * std::sin(angle_rad)));
            const double run = std::sqrt(static_cast<double>(dx * dx + dy * dy)) / resolution;
            slope = std::max(slope, exaggeration * (height(x + dx, y + dy) - height(x, y)) / run);
        }
        sum += 1.0 - slope / std::sqrt(1.0 + slope * slope);
    }
    return sum / directions;
}

/// Largest difference, in codes, between the mean step across the tile's border and the mean step inside it.
double seamExcess(const Picture& p) {
    const auto at = [&](int x, int y, int c) {
        return static_cast<int>(p.values[static_cast<std::size_t>((y * p.width + x) * p.channels + c)]);
    };
    double worst = 0.0;
    for (int c = 0; c < p.channels; ++c) {
        double across_u = 0.0;
        double across_v = 0.0;
        double inside = 0.0;
        for (int i = 0; i < p.width; ++i) {
            across_u += std::abs(at(0, i, c) - at(p.width - 1, i, c));
            across_v += std::abs(at(i, 0, c) - at(i, p.height - 1, c));
            for (int j = 1; j < p.width; ++j) {
                inside +=
                    0.5 *
                    (std::abs(at(j, i, c) - at(j - 1, i, c)) + std::abs(at(i, j, c) - at(i, j - 1, c))) /
                    (p.width - 1.0);
            }
        }
        worst = std::max({worst, (across_u - inside) / p.width, (across_v - inside) / p.width});
    }
    return worst;
}

} // namespace

void bakeBrick(const std::filesystem::path& folder) {
    Field height;
    Picture albedo{resolution, resolution, 3};
    Picture roughness{resolution, resolution, 1};
    const auto uv_of = [](int x, int y) {
        return dvec2{(x + 0.5) / resolution, 1.0 - (y + 0.5) / resolution};
    };
    std::vector<Wall> walls(static_cast<std::size_t>(resolution) * resolution);
    forEachRow(resolution, [&](int y) {
        for (int x = 0; x < resolution; ++x) {
            const dvec2 uv = uv_of(x, y);
            const Wall w = wall(uv);
            height(x, y) = w.height;
            walls[static_cast<std::size_t>(y) * resolution + static_cast<std::size_t>(x)] = w;
            const double worn = tiled(uv, 16, 4, 83);
            const double on_brick = 0.78 + 0.16 * worn - 0.10 * (w.lot[3] - 0.5) + 0.10 * w.chip;
            // In steps of 3: no eye sees them, and the file is half the size.
            const double rough = on_brick * w.brick + (0.95 + 0.04 * worn) * (1.0 - w.brick);
            roughness.set(x, y, std::round(rough * 85.0) / 85.0);
        }
    });
    Picture normal{resolution, resolution, 3};
    Picture occlusion{resolution, resolution, 1};
    double highest = 0.0;
    double slope_sum = 0.0;
    for (int y = 0; y < resolution; ++y) {
        for (int x = 0; x < resolution; ++x)
            highest = std::max(highest, height(x, y));
    }
    forEachRow(resolution, [&](int y) {
        for (int x = 0; x < resolution; ++x) {
            // Central differences; rows run down, v runs up.
            const double du = 0.5 * resolution * (height(x + 1, y) - height(x - 1, y));
            const double dv = 0.5 * resolution * (height(x, y - 1) - height(x, y + 1));
            normal.set(x, y, normalColor(glm::normalize(dvec3{-du, -dv, 1.0})));
            const double open = std::clamp(openness(height, x, y), 0.0, 1.0);
            occlusion.set(x, y, std::round(open * 85.0) / 85.0);
            const dvec2 uv = uv_of(x, y);
            const Wall& w = walls[static_cast<std::size_t>(y) * resolution + static_cast<std::size_t>(x)];
            dvec3 color = w.brick > 0.0 ? brickColor(w, uv) : dvec3{0.0};
            if (w.brick < 1.0) color = glm::mix(mortarColor(uv), color, w.brick);
            // Dirt stays where the rain does not reach, and weather passes over all of it.
            color *= 0.62 + 0.38 * smoothStep(0.30, 0.85, open);
            color *= 1.0 + 0.22 * tiled(uv, 3, 3, 89);
            albedo.set(x, y, srgbEncode(color));
        }
    });
    for (int y = 0; y < resolution; ++y) {
        for (int x = 0; x < resolution; ++x)
            slope_sum += std::abs(height(x + 1, y) - height(x, y)) * resolution;
    }
    double seam = 0.0;
    for (const Picture* p : {&albedo, &normal, &occlusion, &roughness})
        seam = std::max(seam, seamExcess(*p));
    std::printf("brick: %d x %d bricks, relief %.4f tiles, mean slope %.2f, seam excess %.2f codes\n",
                bricks_across, courses, highest, slope_sum / resolution / resolution, seam);
    if (seam > 4.0) throw std::runtime_error("brick: the tile's border shows; nothing was written");
    writeText(folder / "brick.mtl", "# Red brick in running bond, tileable.\n"
                                    "newmtl brick\n"
                                    "Kd 1 1 1\n"
                                    "map_Kd brick_albedo.jpg\n"
                                    "map_ao brick_ao.png\n"
                                    "map_Pr brick_roughness.png\n"
                                    "norm brick_normal.png\n");
    writeJpeg(folder / "brick_albedo.jpg", albedo, 94);
    writePng(folder / "brick_normal.png", normal);
    writePng(folder / "brick_ao.png", occlusion);
    writePng(folder / "brick_roughness.png", roughness);
}

} // namespace bake
