// The cat's files: mesh, atlas, and concrete baked from solid noise and a ray-marched occlusion.
// Every texel is a function of its surface point and normal alone, so charts agree along their seams.
#include "assets.hpp"
#include "atlas.hpp"
#include "files.hpp"
#include "noise.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace bake {
namespace {

constexpr int atlas_resolution = 1024;
constexpr int gutter_texels = 8;

/// Wanted edge length: finer on the head, finest at eyes, mouth and ears, and near the ground, where paws and
/// tail are.
double targetLength(const Vec3& p) {
    const double head = 0.46 + 0.54 * smoothStep(0.13, 0.23, glm::distance(p, Vec3{0.0, 0.82, 0.09}));
    const double face = 0.34 + 0.66 * smoothStep(0.07, 0.13, glm::distance(p, Vec3{0.03, 0.80, 0.21}));
    const double ears = 1.0 - 0.68 * smoothStep(0.895, 0.96, p.y);
    const double feet = 0.70 + 0.30 * smoothStep(0.05, 0.12, p.y);
    return 0.0240 * std::min({head, face, ears, feet});
}

/// The field on a grid, trilinearly read: the occlusion rays ask it some hundred million times.
class SampledField {
  public:
    explicit SampledField(double cell)
        : cell_{cell}, size_{glm::ivec3{glm::ceil((cat_box_max - cat_box_min) / cell)} + 1},
          values_(static_cast<std::size_t>(size_.x) * static_cast<std::size_t>(size_.y) *
                  static_cast<std::size_t>(size_.z)) {
        forEachRow(size_.z, [&](int z) {
            for (int y = 0; y < size_.y; ++y) {
                for (int x = 0; x < size_.x; ++x) {
                    values_[index(x, y, z)] =
                        static_cast<float>(catDistance(cat_box_min + cell_ * Vec3{x, y, z}));
                }
            }
        });
    }

    /// Clamps to the box: outside it the value is that of the wall, which is still no more than the distance.
    double operator()(const Vec3& p) const {
        const Vec3 g = glm::clamp((p - cat_box_min) / cell_, Vec3{0.0}, Vec3{size_ - 1} - 1e-6);
        const glm::ivec3 i{g};
        const Vec3 f = g - Vec3{i};
        const auto at = [&](int dx, int dy, int dz) {
            return static_cast<double>(values_[index(i.x + dx, i.y + dy, i.z + dz)]);
        };
        const auto along_x = [&](int dy, int dz) {
            return at(0, dy, dz) + (at(1, dy, dz) - at(0, dy, dz)) * f.x;
        };
        const double low = along_x(0, 0) + (along_x(1, 0) - along_x(0, 0)) * f.y;
        const double high = along_x(0, 1) + (along_x(1, 1) - along_x(0, 1)) * f.y;
        return low + (high - low) * f.z;
    }

  private:
    std::size_t index(int x, int y, int z) const {
        return (static_cast<std::size_t>(z) * static_cast<std::size_t>(size_.y) +
                static_cast<std::size_t>(y)) *
                   static_cast<std::size_t>(size_.x) +
               static_cast<std::size_t>(x);
    }

    double cell_;
    glm::ivec3 size_;
    std::vector<float> values_;
};

/// Cosine-weighted share of the sky that the point sees, in [0, 1]. The same directions serve every point, so
/// there is neither noise nor a seam; a ray that only just misses counts in part, which hides the rays.
double openness(const SampledField& field, const Vec3& p, const Vec3& n) {
    constexpr int ray_count = 96;
    constexpr double reach = 0.55;
    constexpr double penumbra = 9.0;
    static const auto rays = [] {
        std::array<Vec3, ray_count> sphere;
        const double golden_angle_rad = std::numbers::pi * (3.0 - std::sqrt(5.0));
        for (std::size_t i = 0; i < sphere.size(); ++i) {
            const double y = 1.0 - 2.0 * (static_cast<double>(i) + 0.5) / ray_count;
            const double r = std::sqrt(1.0 - y * y);
            const double turn_rad = golden_angle_rad * static_cast<double>(i);
            sphere[i] = {r * std::cos(turn_rad), y, r * std::sin(turn_rad)};
        }
        return sphere;
    }();
    const Vec3 start = p + n * 0.008;
    double seen = 0.0;
    double weights = 0.0;
    for (const Vec3& ray : rays) {
        const double weight = glm::dot(ray, n);
        if (weight < 0.03) continue;
        weights += weight;
        double open = 1.0;
        // The floor takes light away too, but gives some back: the nearer, the less.
        double end = reach;
        if (ray.y < -1e-3) {
            const double to_floor = std::max(0.0, -start.y / ray.y);
            if (to_floor < reach) {
                end = to_floor;
                open = 0.30 + 0.55 * smoothStep(0.0, 0.5, to_floor);
            }
        }
        double clear = 1.0;
        for (double t = 0.008; t < end;) {
            const double distance = field(start + ray * t);
            clear = std::min(clear, 0.5 + 0.5 * penumbra * distance / t);
            if (clear <= 0.02) break;
            t += std::max(0.010, distance);
        }
        clear = std::max(clear, 0.0);
        seen += weight * open * clear * clear * (3.0 - 2.0 * clear);
    }
    // What the grid is too coarse for: grooves, from the field itself.
    double groove = 0.0;
    for (const double away : {0.005, 0.012})
        groove += 0.5 * std::clamp(catDistance(p + n * away) / away, 0.0, 1.0);
    return seen / weights * (0.45 + 0.55 * groove);
}

struct Flaws {
    double pore;  ///< 1 in the middle of an air hole
    double crack; ///< 1 on the line of a crack
};

Flaws flaws(const Vec3& p) {
    constexpr double crack_shift = 35.0;
    const CellNoise cell = cellNoise(p * 44.0, 11);
    const double radius = cell.id < 0.40 ? 0.12 + 0.42 * cell.id : 0.0;
    const double pore = radius > 0.0 ? 1.0 - smoothStep(0.55 * radius, radius, cell.nearest) : 0.0;
    // Few and fine: the noise behind the mask is read only where a crack may be.
    const double where = smoothStep(0.24, 0.38, fractalNoise(p * 2.6 + crack_shift, 2, 29));
    if (where == 0.0) return {pore, 0.0};
    const double line = std::abs(fractalNoise(p * 3.1 + 7.0, 6, 23, 0.55));
    return {pore, where * (1.0 - smoothStep(0.001, 0.0075, line))};
}

/// Relief of the cast surface, in statue heights along the normal.
double relief(const Vec3& p) {
    const Flaws f = flaws(p);
    return 0.0013 * fractalNoise(p * 24.0, 3, 41) + 0.00048 * fractalNoise(p * 120.0, 2, 43) -
           0.0022 * f.pore - 0.0012 * f.crack;
}

Vec3 reliefNormal(const Vec3& p, const Vec3& n) {
    static constexpr std::array<Vec3, 4> corners{
        {{1.0, -1.0, -1.0}, {-1.0, -1.0, 1.0}, {-1.0, 1.0, -1.0}, {1.0, 1.0, 1.0}}};
    constexpr double step = 7e-4;
    Vec3 gradient{0.0};
    for (const Vec3& c : corners)
        gradient += c * relief(p + c * step);
    gradient /= 4.0 * step;
    // Bump mapping after Blinn, "Simulation of Wrinkled Surfaces", SIGGRAPH 1978: the tangential part tilts.
    return glm::normalize(n - (gradient - n * glm::dot(gradient, n)));
}

struct Concrete {
    Vec3 linear_albedo;
    double roughness;
};

/// Weathered concrete: warm grey, mottled, rain-streaked, dirty where the rain does not reach, a little
/// overgrown.
Concrete concrete(const Vec3& p, const Vec3& n, double open) {
    const Flaws f = flaws(p);
    const double mottle = 0.24 * fractalNoise(p * 5.0, 4, 51) + 0.20 * fractalNoise(p * 23.0, 3, 53) +
                          0.07 * gradientNoise(p * 150.0, 57);
    Vec3 color = Vec3{0.345, 0.318, 0.278} * (1.0 + 1.25 * mottle);
    // A warmer and a cooler batch of cement.
    color *= glm::mix(Vec3{1.05, 1.0, 0.93}, Vec3{0.97, 1.0, 1.04},
                      smoothStep(-0.3, 0.3, fractalNoise(p * 3.0, 3, 59)));
    // Sand grains.
    const CellNoise grain = cellNoise(p * 130.0, 61);
    if (grain.id < 0.16) color *= 1.0 - 0.22 * (1.0 - smoothStep(0.18, 0.36, grain.nearest));

    const double steep = 1.0 - std::abs(n.y);
    const double run = fractalNoise(Vec3{p.x * 17.0, p.y * 1.7, p.z * 17.0}, 4, 67);
    color *= 1.0 - 0.36 * steep * smoothStep(0.04, 0.36, run);
    color *= 1.0 + 0.16 * steep * smoothStep(0.10, 0.45, -run);
    const double edge = fractalNoise(p * 9.0, 4, 71);
    // Soot and dust gather where the sky is hidden; the tops are washed.
    const double washed = smoothStep(0.08, 0.80, open + 0.18 * edge);
    color *= glm::mix(Vec3{0.50, 0.46, 0.41}, Vec3{1.0}, washed);
    color *= 1.0 + 0.08 * smoothStep(0.3, 0.9, n.y);
    const double damp = 1.0 - smoothStep(0.01, 0.11, p.y + 0.07 * edge);
    color *= glm::mix(Vec3{1.0}, Vec3{0.66, 0.64, 0.60}, damp);
    color *= 1.0 - 0.45 * f.pore;
    color *= 1.0 - 0.48 * f.crack;

    double roughness = 0.84 + 0.10 * fractalNoise(p * 14.0, 3, 73) - 0.08 * smoothStep(0.75, 1.0, open) +
                       0.08 * (f.pore + f.crack);
    // Lichen: pale rosettes on what looks up.
    const Vec3 bent = p * 12.0 + 0.55 * Vec3{gradientNoise(p * 40.0, 79), gradientNoise(p * 40.0, 83),
                                             gradientNoise(p * 40.0, 89)};
    const CellNoise rosette = cellNoise(bent, 97);
    const double size = 0.16 + 0.9 * (rosette.id < 0.24 ? rosette.id : 0.0);
    const double lichen = (rosette.id < 0.24 ? 1.0 : 0.0) * smoothStep(-0.15, 0.45, n.y + 0.3 * edge) *
                          (1.0 - smoothStep(0.75 * size, size, rosette.nearest)) *
                          (0.55 + 0.45 * smoothStep(0.2 * size, 0.8 * size, rosette.nearest));
    const Vec3 lichen_color = rosette.id < 0.05 ? Vec3{0.50, 0.34, 0.09} : Vec3{0.47, 0.48, 0.34};
    color = glm::mix(color, lichen_color * (1.0 + 0.8 * mottle), 0.62 * lichen);
    // Moss: in hollows, mostly near the ground.
    const double moss =
        smoothStep(0.16, 0.42,
                   fractalNoise(p * 15.0, 4, 101) + 0.25 * (1.0 - smoothStep(0.0, 0.30, p.y)) +
                       0.22 * (1.0 - smoothStep(0.1, 0.6, open)) - 0.10 + 0.10 * n.y);
    color = glm::mix(color, Vec3{0.105, 0.125, 0.045} * (1.0 + 1.5 * mottle), 0.52 * moss);
    roughness += 0.08 * moss + 0.05 * lichen;
    return {color, std::clamp(roughness, 0.0, 1.0)};
}

/// The direction as the renderer's normal-map colour must hold it: coordinates in Schueler's cotangent frame,
/// "Followup: Normal Mapping Without Precomputed Tangents", 2013, thetenthplanet.de/archives/1180.
Vec3 toTangentSpace(const Vec3& direction, const Vec3& n, const std::array<Vec3, 3>& p,
                    const std::array<Vec2, 3>& uv) {
    const Vec3 dp1_perp = glm::cross(n, p[1] - p[0]);
    const Vec3 dp2_perp = glm::cross(p[2] - p[0], n);
    const Vec2 duv1 = uv[1] - uv[0];
    const Vec2 duv2 = uv[2] - uv[0];
    const Vec3 t = dp2_perp * duv1.x + dp1_perp * duv2.x;
    const Vec3 b = dp2_perp * duv1.y + dp1_perp * duv2.y;
    const double inv_max = 1.0 / std::sqrt(std::max(glm::dot(t, t), glm::dot(b, b)));
    Vec3 local = glm::inverse(glm::dmat3{t * inv_max, b * inv_max, n}) * direction;
    // On a strongly slanted triangle the frame is nearly flat: keep what a texel can hold.
    local.z = std::max(local.z, 0.25 * glm::length(local));
    return glm::normalize(local);
}

/// Grows the covered texels into the empty ones, a ring a pass: a gutter's texel is the mean of its
/// neighbours.
void dilate(Picture& picture, std::vector<bool> covered, int passes) {
    const int w = picture.width;
    const int h = picture.height;
    const auto channels = static_cast<std::size_t>(picture.channels);
    const auto at = [w](int x, int y) {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(w) + static_cast<std::size_t>(x);
    };
    for (int pass = 0; pass < passes; ++pass) {
        std::vector<bool> next = covered;
        for (int y = 0; y < h; ++y) {
            for (int x = 0; x < w; ++x) {
                if (covered[at(x, y)]) continue;
                std::array<unsigned, 3> sum{};
                unsigned count = 0;
                for (int j = std::max(y - 1, 0); j <= std::min(y + 1, h - 1); ++j) {
                    for (int i = std::max(x - 1, 0); i <= std::min(x + 1, w - 1); ++i) {
                        if (!covered[at(i, j)]) continue;
                        ++count;
                        for (std::size_t c = 0; c < channels; ++c)
                            sum[c] += picture.values[at(i, j) * channels + c];
                    }
                }
                if (count == 0) continue;
                next[at(x, y)] = true;
                for (std::size_t c = 0; c < channels; ++c) {
                    picture.values[at(x, y) * channels + c] =
                        static_cast<std::uint8_t>((sum[c] + count / 2) / count);
                }
            }
        }
        covered = std::move(next);
    }
}

/// What no chart's gutter reaches becomes the charts' mean, so that small mip levels stay in tone.
void fillRest(Picture& picture, const std::vector<bool>& covered) {
    const auto channels = static_cast<std::size_t>(picture.channels);
    std::array<std::uint64_t, 3> sum{};
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < covered.size(); ++i) {
        if (!covered[i]) continue;
        ++count;
        for (std::size_t c = 0; c < channels; ++c)
            sum[c] += picture.values[i * channels + c];
    }
    for (std::size_t i = 0; i < covered.size(); ++i) {
        if (covered[i]) continue;
        for (std::size_t c = 0; c < channels; ++c) {
            picture.values[i * channels + c] = static_cast<std::uint8_t>(sum[c] / count);
        }
    }
}

void writeObj(const std::filesystem::path& path, const Mesh& mesh, const Atlas& atlas) {
    std::string text =
        "# A seated cat, made by assets/bake. Units are statue heights, y is up, it looks along +z.\n"
        "mtllib cat.mtl\no cat\n";
    std::array<char, 160> line{};
    const auto add = [&](auto... values) {
        const int length = std::snprintf(line.data(), line.size(), values...);
        text.append(line.data(), static_cast<std::size_t>(length));
    };
    const auto tidy = [](double v) { return std::abs(v) < 5e-6 ? 0.0 : v; }; // no "-0.00000"
    for (const Vec3& p : mesh.positions)
        add("v %.5f %.5f %.5f\n", tidy(p.x), tidy(p.y), tidy(p.z));
    for (const Vec2& uv : atlas.uvs)
        add("vt %.5f %.5f\n", uv.x, uv.y);
    for (const Vec3& n : mesh.normals)
        add("vn %.4f %.4f %.4f\n", tidy(n.x), tidy(n.y), tidy(n.z));
    text += "usemtl concrete\ns 1\n";
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto& [a, b, c] = mesh.triangles[t];
        const auto& [ta, tb, tc] = atlas.corners[t];
        add("f %d/%d/%d %d/%d/%d %d/%d/%d\n", a + 1, ta + 1, a + 1, b + 1, tb + 1, b + 1, c + 1, tc + 1,
            c + 1);
    }
    writeText(path, text);
}

void require(bool holds, const char* what) {
    if (!holds) throw std::runtime_error(std::string{"cat mesh: "} + what + "; nothing was written for it");
}

} // namespace

void bakeCat(const std::filesystem::path& folder) {
    Mesh mesh = remesh(extractSurface(0.011), targetLength, 6);
    // Rounded as the file rounds them: what is checked and baked is what is written.
    for (Vec3& p : mesh.positions)
        p = glm::round(p * 1e5) / 1e5;
    const MeshReport report = inspect(mesh);
    std::printf(
        "cat: %zu vertices, %zu triangles, closed and manifold; smallest angle %.1f deg (at %.3f %.3f %.3f), "
        "mean of the smallest %.1f deg, %.2f %% below 30 deg; a normal and its triangle agree by %.2f at "
        "least\n",
        mesh.positions.size(), mesh.triangles.size(), report.min_angle_deg, report.sharpest_at.x,
        report.sharpest_at.y, report.sharpest_at.z, report.mean_min_angle_deg,
        100.0 * report.share_below_30_deg, report.worst_normal_agreement);
    require(mesh.triangles.size() >= 10000 && mesh.triangles.size() <= 14000,
            "not between 10,000 and 14,000 triangles");
    require(report.components == 1, "it is not one piece");
    require(report.volume > 0.0, "its triangles face inward");
    require(report.min_angle_deg > 10.0, "a triangle has an angle of 10 degrees or less");
    require(report.max_surface_distance < 2e-4, "a vertex is off the surface");
    require(report.worst_normal_agreement > 0.0, "a normal points through its triangle");

    const Atlas atlas = makeAtlas(mesh, atlas_resolution, gutter_texels);
    std::printf("cat: %d charts, %.0f %% of the texels used, %.0f texels a statue height; slant mean %.2f, "
                "worst %.2f\n",
                atlas.charts, 100.0 * atlas.coverage, atlas.texels_per_unit, atlas.mean_slant,
                atlas.worst_slant);
    const std::vector<int> owners = texelOwners(atlas, atlas_resolution);
    std::fflush(stdout);

    const SampledField field{0.0075};
    Picture albedo{atlas_resolution, atlas_resolution, 3};
    Picture normal{atlas_resolution, atlas_resolution, 3};
    Picture arm{atlas_resolution, atlas_resolution, 3};
    forEachRow(atlas_resolution, [&](int y) {
        for (int x = 0; x < atlas_resolution; ++x) {
            const int owner =
                owners[static_cast<std::size_t>(y) * atlas_resolution + static_cast<std::size_t>(x)];
            if (owner < 0) continue;
            const auto t = static_cast<std::size_t>(owner);
            std::array<Vec3, 3> p;
            std::array<Vec3, 3> n;
            std::array<Vec2, 3> uv;
            for (std::size_t k = 0; k < 3; ++k) {
                p[k] = mesh.positions[static_cast<std::size_t>(mesh.triangles[t][k])];
                n[k] = mesh.normals[static_cast<std::size_t>(mesh.triangles[t][k])];
                uv[k] = atlas.uvs[static_cast<std::size_t>(atlas.corners[t][k])];
            }
            const Vec2 at{(x + 0.5) / atlas_resolution, 1.0 - (y + 0.5) / atlas_resolution};
            const auto cross = [](const Vec2& a, const Vec2& b) { return a.x * b.y - a.y * b.x; };
            const double whole = cross(uv[1] - uv[0], uv[2] - uv[0]);
            const double w1 = cross(at - uv[0], uv[2] - uv[0]) / whole;
            const double w2 = cross(uv[1] - uv[0], at - uv[0]) / whole;
            const double w0 = 1.0 - w1 - w2;
            const Vec3 on_mesh = w0 * p[0] + w1 * p[1] + w2 * p[2];
            const Vec3 mesh_normal = glm::normalize(w0 * n[0] + w1 * n[1] + w2 * n[2]);
            Vec3 point = projectToCat(on_mesh);
            if (glm::distance(point, on_mesh) > 0.008) point = on_mesh;
            const Vec3 surface_normal = catNormal(point, 8e-4);
            const double open = openness(field, point, surface_normal);
            const Concrete look = concrete(point, surface_normal, open);
            albedo.set(x, y, srgbEncode(look.linear_albedo));
            normal.set(x, y,
                       normalColor(toTangentSpace(reliefNormal(point, surface_normal), mesh_normal, p, uv)));
            // Half the codes: the eye sees no difference and the file is a third smaller.
            const auto coarse = [](double v) { return std::round(v * 127.5) / 127.5; };
            arm.set(x, y, Vec3{coarse(open), coarse(look.roughness), 0.0});
        }
    });
    std::vector<bool> covered(owners.size());
    for (std::size_t i = 0; i < owners.size(); ++i)
        covered[i] = owners[i] >= 0;
    for (Picture* picture : {&albedo, &normal, &arm}) {
        fillRest(*picture, covered);
        dilate(*picture, covered, gutter_texels + 4);
    }

    writeObj(folder / "cat.obj", mesh, atlas);
    writeText(folder / "cat.mtl",
              "# Weathered concrete. arm packs occlusion (r), roughness (g), metallic (b).\n"
              "newmtl concrete\n"
              "Kd 1 1 1\n"
              "map_Kd cat_albedo.jpg\n"
              "map_ao -imfchan r cat_arm.png\n"
              "map_Pr -imfchan g cat_arm.png\n"
              "map_Pm -imfchan b cat_arm.png\n"
              "norm cat_normal.png\n");
    writeJpeg(folder / "cat_albedo.jpg", albedo, 95);
    writePng(folder / "cat_normal.png", normal);
    writePng(folder / "cat_arm.png", arm);
}

} // namespace bake
