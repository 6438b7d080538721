// Charts by variational shape approximation, planar projection, bitmap packing.
// All choices break ties by index, so the same mesh always gives the same atlas.
#include "atlas.hpp"

#include <algorithm>
#include <bitset>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>
#include <queue>
#include <stdexcept>
#include <string>
#include <utility>

namespace bake {
namespace {

constexpr int first_charts = 30;
constexpr double min_slant_cosine = 0.52; // a chart's triangles stay within 59 degrees of its plane
constexpr double crease_cosine = 0.20;    // but small patches, as in creases, may lean more than open a chart
constexpr double small_patch_area = 0.0030;
constexpr int cell_texels = 4; // the packing's grid

struct Face {
    Vec3 normal{0.0};
    Vec3 centre{0.0};
    double area = 0.0;
    std::array<int, 3> neighbours{};
};

std::vector<Face> facesOf(const Mesh& mesh) {
    std::vector<Face> faces(mesh.triangles.size());
    std::map<std::pair<int, int>, int> owner;
    for (std::size_t t = 0; t < faces.size(); ++t) {
        const auto& corners = mesh.triangles[t];
        const auto at = [&](std::size_t k) { return mesh.positions[static_cast<std::size_t>(corners[k])]; };
        const Vec3 scaled = glm::cross(at(1) - at(0), at(2) - at(0));
        faces[t].area = 0.5 * glm::length(scaled);
        faces[t].normal = scaled / (2.0 * faces[t].area);
        faces[t].centre = (at(0) + at(1) + at(2)) / 3.0;
        for (std::size_t k = 0; k < 3; ++k)
            owner[{corners[k], corners[(k + 1) % 3]}] = static_cast<int>(t);
    }
    for (std::size_t t = 0; t < faces.size(); ++t) {
        const auto& corners = mesh.triangles[t];
        for (std::size_t k = 0; k < 3; ++k) {
            faces[t].neighbours[k] = owner.at({corners[(k + 1) % 3], corners[k]});
        }
    }
    return faces;
}

/// Floods the charts from their seeds, best-fitting triangle first. Triangles no chart may take stay -1.
std::vector<int> flood(const std::vector<Face>& faces, const std::vector<int>& seeds,
                       const std::vector<Vec3>& axes, const std::vector<double>& limits) {
    struct Offer {
        double cost;
        int order;
        int face;
        int chart;
        bool operator>(const Offer& o) const { return cost != o.cost ? cost > o.cost : order > o.order; }
    };
    std::priority_queue<Offer, std::vector<Offer>, std::greater<>> offers;
    std::vector<int> chart_of(faces.size(), -1);
    int order = 0;
    const auto offer = [&](int face, std::size_t chart) {
        const Face& f = faces[static_cast<std::size_t>(face)];
        const double cosine = glm::dot(f.normal, axes[chart]);
        if (cosine < limits[static_cast<std::size_t>(face)]) return;
        // The distance term keeps charts compact where the surface is flat.
        const double away = glm::distance(f.centre, faces[static_cast<std::size_t>(seeds[chart])].centre);
        offers.push({1.0 - cosine + 0.6 * away, order++, face, static_cast<int>(chart)});
    };
    for (std::size_t c = 0; c < seeds.size(); ++c) {
        chart_of[static_cast<std::size_t>(seeds[c])] = static_cast<int>(c);
    }
    for (std::size_t c = 0; c < seeds.size(); ++c) {
        for (const int n : faces[static_cast<std::size_t>(seeds[c])].neighbours)
            offer(n, c);
    }
    while (!offers.empty()) {
        const Offer best = offers.top();
        offers.pop();
        int& chart = chart_of[static_cast<std::size_t>(best.face)];
        if (chart >= 0) continue;
        chart = best.chart;
        for (const int n : faces[static_cast<std::size_t>(best.face)].neighbours) {
            if (chart_of[static_cast<std::size_t>(n)] < 0) offer(n, static_cast<std::size_t>(best.chart));
        }
    }
    return chart_of;
}

std::vector<Vec3> chartAxes(const std::vector<Face>& faces, const std::vector<int>& chart_of,
                            std::size_t charts) {
    std::vector<Vec3> axes(charts, Vec3{0.0});
    for (std::size_t t = 0; t < faces.size(); ++t) {
        if (chart_of[t] >= 0) axes[static_cast<std::size_t>(chart_of[t])] += faces[t].normal * faces[t].area;
    }
    for (Vec3& axis : axes)
        axis = glm::normalize(axis);
    return axes;
}

/// Moves each seed to the triangle in the middle of its chart that fits the axis best.
std::vector<int> centredSeeds(const std::vector<Face>& faces, const std::vector<int>& chart_of,
                              const std::vector<Vec3>& axes) {
    std::vector<Vec3> middle(axes.size(), Vec3{0.0});
    std::vector<double> area(axes.size(), 0.0);
    for (std::size_t t = 0; t < faces.size(); ++t) {
        if (chart_of[t] < 0) continue;
        const auto c = static_cast<std::size_t>(chart_of[t]);
        middle[c] += faces[t].centre * faces[t].area;
        area[c] += faces[t].area;
    }
    std::vector<int> seeds(axes.size(), -1);
    std::vector<double> best(axes.size(), 1e9);
    for (std::size_t t = 0; t < faces.size(); ++t) {
        if (chart_of[t] < 0) continue;
        const auto c = static_cast<std::size_t>(chart_of[t]);
        const double cost = 1.0 - glm::dot(faces[t].normal, axes[c]) +
                            4.0 * glm::distance(faces[t].centre, middle[c] / area[c]);
        if (cost < best[c]) {
            best[c] = cost;
            seeds[c] = static_cast<int>(t);
        }
    }
    return seeds;
}

/// A chart laid flat: its vertices on its plane, turned so that its bounding box is smallest.
struct FlatChart {
    std::vector<int> triangles;
    std::map<int, Vec2> place; ///< by mesh vertex; from (0, 0), in statue heights
    Vec2 extent{0.0};
};

FlatChart flatten(const Mesh& mesh, const std::vector<int>& triangles, const Vec3& axis) {
    FlatChart chart;
    chart.triangles = triangles;
    const Vec3 aside = std::abs(axis.y) < 0.9 ? Vec3{0.0, 1.0, 0.0} : Vec3{1.0, 0.0, 0.0};
    const Vec3 right = glm::normalize(glm::cross(aside, axis));
    const Vec3 up = glm::cross(axis, right); // right x up = axis: counter-clockwise stays so
    double best_area = 1e9;
    constexpr int turns = 45;
    for (int turn = 0; turn < turns; ++turn) {
        const double angle_rad = turn * (0.5 * std::numbers::pi / turns);
        const Vec2 x_axis{std::cos(angle_rad), std::sin(angle_rad)};
        Vec2 low{1e9};
        Vec2 high{-1e9};
        std::map<int, Vec2> place;
        for (const int t : triangles) {
            for (const int v : mesh.triangles[static_cast<std::size_t>(t)]) {
                const Vec3& p = mesh.positions[static_cast<std::size_t>(v)];
                const Vec2 flat{glm::dot(p, right), glm::dot(p, up)};
                const Vec2 q{glm::dot(flat, x_axis), glm::dot(flat, Vec2{-x_axis.y, x_axis.x})};
                place[v] = q;
                low = glm::min(low, q);
                high = glm::max(high, q);
            }
        }
        const Vec2 extent = high - low;
        if (extent.x * extent.y < best_area) {
            best_area = extent.x * extent.y;
            for (auto& [v, q] : place)
                q -= low;
            chart.place = std::move(place);
            chart.extent = extent;
        }
    }
    return chart;
}

Vec2 quarterTurned(const Vec2& p, const Vec2& extent, int quarters) {
    switch (quarters) {
    case 1:
        return {extent.y - p.y, p.x};
    case 2:
        return extent - p;
    case 3:
        return {p.y, extent.x - p.x};
    default:
        return p;
    }
}

/// Calls `visit(x, y)` for the integer points strictly inside, or on an edge of, a counter-clockwise
/// triangle.
template <typename Visit>
void rasterise(const Vec2& a, const Vec2& b, const Vec2& c, Visit visit) {
    const auto edge = [](const Vec2& p, const Vec2& q, const Vec2& r) {
        return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
    };
    const int x0 = static_cast<int>(std::floor(std::min({a.x, b.x, c.x})));
    const int x1 = static_cast<int>(std::ceil(std::max({a.x, b.x, c.x})));
    const int y0 = static_cast<int>(std::floor(std::min({a.y, b.y, c.y})));
    const int y1 = static_cast<int>(std::ceil(std::max({a.y, b.y, c.y})));
    for (int y = y0; y <= y1; ++y) {
        for (int x = x0; x <= x1; ++x) {
            const Vec2 p{x, y};
            if (edge(a, b, p) >= 0.0 && edge(b, c, p) >= 0.0 && edge(c, a, p) >= 0.0) visit(x, y);
        }
    }
}

constexpr std::size_t max_cells = 512;
using Row = std::bitset<max_cells>;

/// The cells a chart needs at a scale (texels a unit) with its gutter; rows from the bottom.
std::vector<Row> footprint(const Mesh& mesh, const FlatChart& chart, double scale, int quarters, int gutter) {
    const Vec2 extent = quarters % 2 == 0 ? chart.extent : Vec2{chart.extent.y, chart.extent.x};
    const auto cells = [&](double length) {
        return static_cast<std::size_t>(std::ceil((length * scale + 2.0 * gutter) / cell_texels)) + 1;
    };
    const std::size_t width = std::min(cells(extent.x), max_cells);
    const std::size_t height = cells(extent.y);
    std::vector<Row> texel_rows(height);
    const auto mark = [&](double x_texel, double y_texel) {
        // Every cell within the gutter of this texel, as a square.
        const auto cell = [](double v) { return static_cast<std::size_t>(std::max(0.0, v / cell_texels)); };
        const std::size_t x1 = std::min(cell(x_texel + gutter), width - 1);
        const std::size_t y1 = std::min(cell(y_texel + gutter), height - 1);
        for (std::size_t y = cell(y_texel - gutter); y <= y1; ++y) {
            for (std::size_t x = cell(x_texel - gutter); x <= x1; ++x)
                texel_rows[y].set(x);
        }
    };
    for (const int t : chart.triangles) {
        std::array<Vec2, 3> corner;
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec2& p = chart.place.at(mesh.triangles[static_cast<std::size_t>(t)][k]);
            corner[k] = quarterTurned(p, chart.extent, quarters) * scale + static_cast<double>(gutter);
        }
        for (std::size_t k = 0; k < 3; ++k) {
            for (int i = 0; i < 8; ++i) {
                const Vec2 p = glm::mix(corner[k], corner[(k + 1) % 3], i / 8.0);
                mark(p.x, p.y);
            }
        }
        rasterise(corner[0] * 0.5, corner[1] * 0.5, corner[2] * 0.5,
                  [&](int x, int y) { mark(x * 2.0, y * 2.0); });
    }
    return texel_rows;
}

struct Placement {
    int x_cell = 0;
    int y_cell = 0;
    int quarters = 0;
};

/// First fit from the bottom, tallest chart first, in four turns. Empty if the charts do not fit.
std::optional<std::vector<Placement>> pack(const Mesh& mesh, const std::vector<FlatChart>& charts,
                                           double scale, int resolution, int gutter) {
    const int cells = resolution / cell_texels;
    std::vector<Row> taken(static_cast<std::size_t>(cells));
    std::vector<std::size_t> order(charts.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        const auto size = [&](std::size_t c) { return std::max(charts[c].extent.x, charts[c].extent.y); };
        return size(a) > size(b);
    });
    std::vector<Placement> placements(charts.size());
    for (const std::size_t c : order) {
        std::optional<Placement> best;
        std::vector<Row> best_rows;
        int best_top = 0;
        for (int quarters = 0; quarters < 4; ++quarters) {
            const std::vector<Row> rows = footprint(mesh, charts[c], scale, quarters, gutter);
            Row any;
            for (const Row& row : rows)
                any |= row;
            int width = 0;
            for (std::size_t x = 0; x < max_cells; ++x) {
                if (any.test(x)) width = static_cast<int>(x) + 1;
            }
            int height = static_cast<int>(rows.size());
            while (height > 0 && rows[static_cast<std::size_t>(height - 1)].none())
                --height;
            const auto fits = [&](int x, int y) {
                for (int r = 0; r < height; ++r) {
                    const Row shifted = rows[static_cast<std::size_t>(r)] << static_cast<std::size_t>(x);
                    if ((shifted & taken[static_cast<std::size_t>(y + r)]).any()) return false;
                }
                return true;
            };
            bool found = false;
            for (int y = 0; y + height <= cells && !found; ++y) {
                if (best && y + height >= best_top) break;
                for (int x = 0; x + width <= cells && !found; ++x) {
                    if (!fits(x, y)) continue;
                    best = Placement{x, y, quarters};
                    best_top = y + height;
                    best_rows.assign(rows.begin(), rows.begin() + height);
                    found = true;
                }
            }
        }
        if (!best) return std::nullopt;
        for (std::size_t r = 0; r < best_rows.size(); ++r) {
            taken[static_cast<std::size_t>(best->y_cell) + r] |= best_rows[r]
                                                                 << static_cast<std::size_t>(best->x_cell);
        }
        placements[c] = *best;
    }
    return placements;
}

/// A triangle of each chart that lies over another of the same chart once projected, or nothing.
std::vector<int> foldedTriangles(const Mesh& mesh, const std::vector<FlatChart>& charts) {
    constexpr double texels_per_unit = 900.0;
    std::vector<int> folded;
    for (const FlatChart& chart : charts) {
        std::map<std::pair<int, int>, int> owner;
        for (const int t : chart.triangles) {
            std::array<Vec2, 3> corner;
            for (std::size_t k = 0; k < 3; ++k) {
                corner[k] = chart.place.at(mesh.triangles[static_cast<std::size_t>(t)][k]) * texels_per_unit;
            }
            // Shrunk towards its centre, so that neighbours sharing an edge do not count.
            const Vec2 centre = (corner[0] + corner[1] + corner[2]) / 3.0;
            for (Vec2& p : corner)
                p = glm::mix(p, centre, 0.02);
            bool clash = false;
            rasterise(corner[0], corner[1], corner[2], [&](int x, int y) {
                clash |= !owner.try_emplace({x, y}, t).second;
            });
            if (clash) {
                folded.push_back(t);
                break;
            }
        }
    }
    return folded;
}

} // namespace

Atlas makeAtlas(const Mesh& mesh, int resolution, int gutter) {
    const std::vector<Face> faces = facesOf(mesh);
    // Seeds start far from each other, then settle as in Lloyd's algorithm.
    std::vector<int> seeds{0};
    std::vector<double> away(faces.size(), 1e9);
    while (seeds.size() < static_cast<std::size_t>(first_charts)) {
        const Face& last = faces[static_cast<std::size_t>(seeds.back())];
        for (std::size_t t = 0; t < faces.size(); ++t) {
            const double metric = 1.0 - glm::dot(faces[t].normal, last.normal) +
                                  3.0 * glm::distance(faces[t].centre, last.centre);
            away[t] = std::min(away[t], metric);
        }
        seeds.push_back(static_cast<int>(std::max_element(away.begin(), away.end()) - away.begin()));
    }
    std::vector<Vec3> axes;
    for (const int s : seeds)
        axes.push_back(faces[static_cast<std::size_t>(s)].normal);
    std::vector<int> chart_of;
    for (int round = 0; round < 12; ++round) {
        chart_of = flood(faces, seeds, axes, std::vector<double>(faces.size(), -1.0));
        axes = chartAxes(faces, chart_of, seeds.size());
        seeds = centredSeeds(faces, chart_of, axes);
    }
    // Then no triangle may lean too far from its chart's plane nor lie over another: new charts where they
    // do.
    std::vector<FlatChart> charts;
    std::vector<double> limits(faces.size(), min_slant_cosine);
    constexpr int max_rounds = 80;
    for (int round = 0;; ++round) {
        if (round == max_rounds) throw std::runtime_error("cat atlas: charts still fold after many cuts");
        chart_of = flood(faces, seeds, axes, limits);
        std::vector<int> extra;
        bool loosened = false;
        // One new seed for each connected group of homeless triangles: its largest.
        std::vector<bool> seen(faces.size(), false);
        for (std::size_t t = 0; t < faces.size(); ++t) {
            if (chart_of[t] >= 0 || seen[t]) continue;
            std::vector<int> group{static_cast<int>(t)};
            seen[t] = true;
            for (std::size_t i = 0; i < group.size(); ++i) {
                for (const int n : faces[static_cast<std::size_t>(group[i])].neighbours) {
                    const auto index = static_cast<std::size_t>(n);
                    if (chart_of[index] >= 0 || seen[index]) continue;
                    seen[index] = true;
                    group.push_back(n);
                }
            }
            double area = 0.0;
            for (const int g : group)
                area += faces[static_cast<std::size_t>(g)].area;
            if (area < small_patch_area && limits[t] > crease_cosine) {
                for (const int g : group)
                    limits[static_cast<std::size_t>(g)] = crease_cosine;
                loosened = true;
                continue;
            }
            extra.push_back(*std::max_element(group.begin(), group.end(), [&](int a, int b) {
                return faces[static_cast<std::size_t>(a)].area < faces[static_cast<std::size_t>(b)].area;
            }));
        }
        if (extra.empty() && !loosened) {
            std::vector<std::vector<int>> members(seeds.size());
            for (std::size_t t = 0; t < faces.size(); ++t) {
                members[static_cast<std::size_t>(chart_of[t])].push_back(static_cast<int>(t));
            }
            charts.clear();
            for (std::size_t c = 0; c < seeds.size(); ++c)
                charts.push_back(flatten(mesh, members[c], axes[c]));
            extra = foldedTriangles(mesh, charts);
            if (extra.empty()) break;
        }
        for (const int t : extra) {
            seeds.push_back(t);
            axes.push_back(faces[static_cast<std::size_t>(t)].normal);
        }
    }

    double low = 100.0;
    double high = 2.0 * resolution;
    std::optional<std::vector<Placement>> placements;
    for (int step = 0; step < 10; ++step) {
        const double scale = 0.5 * (low + high);
        if (auto fit = pack(mesh, charts, scale, resolution, gutter)) {
            placements = std::move(fit);
            low = scale;
        } else {
            high = scale;
        }
    }
    if (!placements) throw std::runtime_error("cat atlas: the charts do not fit");

    Atlas atlas;
    atlas.charts = static_cast<int>(charts.size());
    atlas.texels_per_unit = low;
    atlas.chart_of = chart_of;
    atlas.corners.resize(mesh.triangles.size());
    for (std::size_t c = 0; c < charts.size(); ++c) {
        const Placement& at = (*placements)[c];
        std::map<int, int> uv_of;
        for (const auto& [v, flat] : charts[c].place) {
            uv_of[v] = static_cast<int>(atlas.uvs.size());
            const Vec2 texel = quarterTurned(flat, charts[c].extent, at.quarters) * low +
                               static_cast<double>(gutter) +
                               static_cast<double>(cell_texels) * Vec2{at.x_cell, at.y_cell};
            atlas.uvs.push_back(texel / static_cast<double>(resolution));
        }
        for (const int t : charts[c].triangles) {
            for (std::size_t k = 0; k < 3; ++k) {
                atlas.corners[static_cast<std::size_t>(t)][k] =
                    uv_of.at(mesh.triangles[static_cast<std::size_t>(t)][k]);
            }
        }
    }
    double slant_area = 0.0;
    double area = 0.0;
    for (std::size_t t = 0; t < faces.size(); ++t) {
        const double cosine = glm::dot(faces[t].normal, axes[static_cast<std::size_t>(chart_of[t])]);
        atlas.worst_slant = std::min(atlas.worst_slant, cosine);
        slant_area += cosine * faces[t].area;
        area += faces[t].area;
    }
    atlas.mean_slant = slant_area / area;
    const std::vector<int> owners = texelOwners(atlas, resolution);
    const auto covered = std::count_if(owners.begin(), owners.end(), [](int t) { return t >= 0; });
    atlas.coverage = static_cast<double>(covered) / static_cast<double>(owners.size());
    return atlas;
}

std::vector<int> texelOwners(const Atlas& atlas, int resolution) {
    std::vector<int> owners(static_cast<std::size_t>(resolution) * static_cast<std::size_t>(resolution), -1);
    for (std::size_t t = 0; t < atlas.corners.size(); ++t) {
        std::array<Vec2, 3> corner;
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec2& uv = atlas.uvs[static_cast<std::size_t>(atlas.corners[t][k])];
            if (!(uv.x >= 0.0 && uv.x <= 1.0 && uv.y >= 0.0 && uv.y <= 1.0)) {
                throw std::runtime_error("cat atlas: a texture coordinate lies outside [0, 1]");
            }
            corner[k] = uv * static_cast<double>(resolution) - 0.5;
        }
        const Vec2 centre = (corner[0] + corner[1] + corner[2]) / 3.0;
        rasterise(corner[0], corner[1], corner[2], [&](int x, int y) {
            if (x < 0 || y < 0 || x >= resolution || y >= resolution) return;
            const auto index =
                static_cast<std::size_t>(resolution - 1 - y) * static_cast<std::size_t>(resolution) +
                static_cast<std::size_t>(x);
            int& owner = owners[index];
            if (owner >= 0) {
                // A centre may lie on a shared edge; deep inside both triangles it may not.
                const Vec2 inner = glm::mix(Vec2{x, y}, centre, -0.02);
                bool deep = false;
                rasterise(corner[0] - inner, corner[1] - inner, corner[2] - inner,
                          [&](int dx, int dy) { deep |= dx == 0 && dy == 0; });
                if (deep && atlas.chart_of[static_cast<std::size_t>(owner)] != atlas.chart_of[t]) {
                    throw std::runtime_error("cat atlas: two charts claim texel " + std::to_string(x) + ", " +
                                             std::to_string(y));
                }
                return;
            }
            owner = static_cast<int>(t);
        });
    }
    return owners;
}

} // namespace bake
