// Marching tetrahedra, isotropic remeshing, and the closed-manifold check.
// Vertex positions come from Newton steps on the field, so the mesh lies on the surface whatever the grid
// was.
#include "mesh.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <map>
#include <numeric>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <utility>

namespace bake {
namespace {

using Triangle = std::array<int, 3>;

Vec3 scaledNormal(const Vec3& a, const Vec3& b, const Vec3& c) { return glm::cross(b - a, c - a); }

double minAngleCosine(const Vec3& a, const Vec3& b, const Vec3& c) {
    const auto cosine = [](const Vec3& u, const Vec3& v) {
        const double n = std::sqrt(glm::dot(u, u) * glm::dot(v, v));
        return n > 0.0 ? glm::dot(u, v) / n : 1.0;
    };
    return std::max({cosine(b - a, c - a), cosine(a - b, c - b), cosine(a - c, b - c)});
}

void keepLargestPart(Mesh& mesh) {
    std::vector<int> parent(mesh.positions.size());
    std::iota(parent.begin(), parent.end(), 0);
    const auto root = [&](int v) {
        while (parent[static_cast<std::size_t>(v)] != v) {
            auto& up = parent[static_cast<std::size_t>(v)];
            up = parent[static_cast<std::size_t>(up)];
            v = up;
        }
        return v;
    };
    for (const Triangle& t : mesh.triangles) {
        for (std::size_t k = 1; k < 3; ++k)
            parent[static_cast<std::size_t>(root(t[k]))] = root(t[0]);
    }
    std::map<int, int> size;
    for (const Triangle& t : mesh.triangles)
        ++size[root(t[0])];
    const int largest = std::max_element(size.begin(), size.end(), [](const auto& a, const auto& b) {
                            return a.second < b.second;
                        })->first;
    std::erase_if(mesh.triangles, [&](const Triangle& t) { return root(t[0]) != largest; });
}

/// Drops the positions that no triangle uses.
void compact(Mesh& mesh) {
    std::vector<int> new_index(mesh.positions.size(), -1);
    std::vector<Vec3> kept;
    for (Triangle& t : mesh.triangles) {
        for (int& v : t) {
            int& index = new_index[static_cast<std::size_t>(v)];
            if (index < 0) {
                index = static_cast<int>(kept.size());
                kept.push_back(mesh.positions[static_cast<std::size_t>(v)]);
            }
            v = index;
        }
    }
    mesh.positions = std::move(kept);
}

/// The mesh while it is being edited: triangles may be dead (first index -1), vertices know their triangles.
class Remesher {
  public:
    Remesher(const Mesh& mesh, const std::function<double(const Vec3&)>& target_length)
        : positions_{mesh.positions}, triangles_{mesh.triangles}, fans_(mesh.positions.size()),
          normals_(mesh.positions.size()), target_length_{target_length} {
        for (std::size_t t = 0; t < triangles_.size(); ++t) {
            for (const int v : triangles_[t])
                fan(v).push_back(static_cast<int>(t));
        }
        for (std::size_t v = 0; v < positions_.size(); ++v)
            normals_[v] = catNormal(positions_[v]);
    }

    void splitLongEdges() {
        for (const auto& [a, b] : edges()) {
            const double limit = 4.0 / 3.0 * target_length_(0.5 * (position(a) + position(b)));
            if (glm::distance(position(a), position(b)) > limit) split(a, b);
        }
    }

    void collapseShortEdges() {
        for (const auto& [a, b] : edges()) {
            if (!isEdge(a, b)) continue;
            const double limit = 4.0 / 5.0 * target_length_(0.5 * (position(a) + position(b)));
            if (glm::distance(position(a), position(b)) < limit) collapse(a, b);
        }
    }

    /// Collapses the shortest edge of every triangle with an angle below the limit.
    void removeSlivers(double min_angle_deg) {
        const double limit = std::cos(glm::radians(min_angle_deg));
        for (std::size_t t = 0; t < triangles_.size(); ++t) {
            if (triangles_[t][0] < 0) continue;
            const auto [i, j, k] = triangles_[t];
            if (minAngleCosine(position(i), position(j), position(k)) < limit) continue;
            const double ij = glm::distance(position(i), position(j));
            const double jk = glm::distance(position(j), position(k));
            const double ki = glm::distance(position(k), position(i));
            if (ij <= jk && ij <= ki) {
                collapse(i, j);
            } else if (jk <= ki) {
                collapse(j, k);
            } else {
                collapse(k, i);
            }
        }
    }

    /// Flips the edges whose opposite angles sum to more than 180 degrees (Delaunay) or, with `by_valence`,
    /// those whose flip brings the four valences nearer to six.
    void flipEdges(bool by_valence) {
        for (const auto& [a, b] : edges()) {
            if (isEdge(a, b)) flip(a, b, by_valence);
        }
    }

    void relax() {
        std::vector<Vec3> moved = positions_;
        for (std::size_t v = 0; v < positions_.size(); ++v) {
            if (fans_[v].empty()) continue;
            Vec3 sum{0.0};
            double weights = 0.0;
            for (const int t : fans_[v]) {
                const auto& [i, j, k] = triangles_[static_cast<std::size_t>(t)];
                const Vec3 centre = (position(i) + position(j) + position(k)) / 3.0;
                const double length = target_length_(centre);
                const double area =
                    glm::length(scaledNormal(position(i), position(j), position(k))) / (length * length);
                sum += centre * area;
                weights += area;
            }
            if (weights <= 0.0) continue;
            const Vec3 step = sum / weights - positions_[v];
            moved[v] = positions_[v] + 0.8 * (step - normals_[v] * glm::dot(step, normals_[v]));
        }
        for (std::size_t v = 0; v < positions_.size(); ++v) {
            if (fans_[v].empty()) continue;
            const Vec3 candidate = projectToCat(moved[v]);
            if (glm::distance(candidate, positions_[v]) > target_length_(positions_[v])) continue;
            const Vec3 candidate_normal = catNormal(candidate);
            const int vertex = static_cast<int>(v);
            const bool sound = std::all_of(fans_[v].begin(), fans_[v].end(), [&](int t) {
                return facesOut(triangle(t), vertex, candidate, candidate_normal) &&
                       staysWide(triangle(t), vertex, candidate);
            });
            if (!sound) continue;
            positions_[v] = candidate;
            normals_[v] = candidate_normal;
        }
    }

    Mesh result() const {
        Mesh mesh{.positions = positions_, .normals = {}, .triangles = {}};
        for (const Triangle& t : triangles_) {
            if (t[0] >= 0) mesh.triangles.push_back(t);
        }
        compact(mesh);
        // Over a length near the triangles' own, so that a groove finer than they are tilts no normal; the
        // normal map holds what is left.
        for (const Vec3& p : mesh.positions)
            mesh.normals.push_back(catNormal(p, 2e-3));
        std::vector<Vec3> mean(mesh.positions.size(), Vec3{0.0});
        std::vector<double> agreement(mesh.positions.size(), 1.0);
        for (const Triangle& t : mesh.triangles) {
            const auto at = [&](std::size_t k) { return mesh.positions[static_cast<std::size_t>(t[k])]; };
            const Vec3 facing = scaledNormal(at(0), at(1), at(2));
            for (const int corner : t) {
                const auto v = static_cast<std::size_t>(corner);
                mean[v] += facing;
                agreement[v] =
                    std::min(agreement[v], glm::dot(mesh.normals[v], facing) / glm::length(facing));
            }
        }
        // In a crease the field has two normals: there the triangles decide.
        for (std::size_t v = 0; v < mean.size(); ++v) {
            if (agreement[v] < 0.35) mesh.normals[v] = glm::normalize(mean[v]);
        }
        return mesh;
    }

  private:
    using Edge = std::pair<int, int>;

    static constexpr double sliver_cosine = 0.95; // 18 degrees

    const Vec3& position(int v) const { return positions_[static_cast<std::size_t>(v)]; }
    const Vec3& normal(int v) const { return normals_[static_cast<std::size_t>(v)]; }
    std::vector<int>& fan(int v) { return fans_[static_cast<std::size_t>(v)]; }
    const std::vector<int>& fan(int v) const { return fans_[static_cast<std::size_t>(v)]; }
    Triangle& triangle(int t) { return triangles_[static_cast<std::size_t>(t)]; }
    const Triangle& triangle(int t) const { return triangles_[static_cast<std::size_t>(t)]; }

    static bool has(const Triangle& t, int v) { return t[0] == v || t[1] == v || t[2] == v; }

    std::vector<Edge> edges() const {
        std::vector<Edge> list;
        for (const Triangle& t : triangles_) {
            if (t[0] < 0) continue;
            for (std::size_t k = 0; k < 3; ++k) {
                if (t[k] < t[(k + 1) % 3]) list.emplace_back(t[k], t[(k + 1) % 3]);
            }
        }
        std::sort(list.begin(), list.end());
        return list;
    }

    bool isEdge(int a, int b) const {
        return std::any_of(fan(a).begin(), fan(a).end(), [&](int t) { return has(triangle(t), b); });
    }

    /// The triangle in which b follows a, and the corner opposite.
    std::pair<int, int> side(int a, int b) const {
        for (const int t : fan(a)) {
            const Triangle& corners = triangle(t);
            for (std::size_t k = 0; k < 3; ++k) {
                if (corners[k] == a && corners[(k + 1) % 3] == b) return {t, corners[(k + 2) % 3]};
            }
        }
        throw std::runtime_error("remesh: an edge lost one of its triangles");
    }

    std::vector<int> neighbours(int v) const {
        std::vector<int> ring;
        for (const int t : fan(v)) {
            for (const int other : triangle(t)) {
                if (other != v) ring.push_back(other);
            }
        }
        std::sort(ring.begin(), ring.end());
        ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
        return ring;
    }

    void replaceCorner(int t, int from, int to) {
        for (int& v : triangle(t)) {
            if (v == from) v = to;
        }
    }

    /// Cosine between a triangle's plane and its vertices' normals, once `vertex` has moved.
    double agreement(const Triangle& t, int vertex, const Vec3& to, const Vec3& to_normal) const {
        std::array<Vec3, 3> corner;
        Vec3 mean{0.0};
        for (std::size_t k = 0; k < 3; ++k) {
            const bool moves = t[k] == vertex;
            corner[k] = moves ? to : position(t[k]);
            mean += moves ? to_normal : normal(t[k]);
        }
        const Vec3 facing = scaledNormal(corner[0], corner[1], corner[2]);
        const double size = glm::length(facing) * glm::length(mean);
        return size > 1e-14 ? glm::dot(facing, mean) / size : -1.0;
    }

    /// Cosine of the triangle's smallest angle, once `vertex` has moved.
    double sharpness(const Triangle& t, int vertex, const Vec3& to) const {
        std::array<Vec3, 3> corner;
        for (std::size_t k = 0; k < 3; ++k)
            corner[k] = t[k] == vertex ? to : position(t[k]);
        return minAngleCosine(corner[0], corner[1], corner[2]);
    }

    /// Whether the move leaves the triangle facing outward, or at least better than it did.
    bool facesOut(const Triangle& t, int vertex, const Vec3& to, const Vec3& to_normal) const {
        const double after = agreement(t, vertex, to, to_normal);
        return after > 0.6 || after > agreement(t, vertex, position(vertex), normal(vertex));
    }

    /// Whether the move makes no sliver, or at least a lesser one than there was.
    bool staysWide(const Triangle& t, int vertex, const Vec3& to) const {
        const double after = sharpness(t, vertex, to);
        return after < sliver_cosine || after < sharpness(t, vertex, position(vertex));
    }

    void split(int a, int b) {
        const auto [t0, c] = side(a, b);
        const auto [t1, d] = side(b, a);
        const Vec3 middle = projectToCat(0.5 * (position(a) + position(b)));
        if (glm::distance(middle, position(a)) > glm::distance(position(a), position(b))) return;
        const int m = static_cast<int>(positions_.size());
        positions_.push_back(middle);
        normals_.push_back(catNormal(middle));
        fans_.emplace_back();
        const int t2 = static_cast<int>(triangles_.size());
        replaceCorner(t0, b, m); // a m c
        replaceCorner(t1, b, m); // m a d
        triangles_.push_back({m, b, c});
        triangles_.push_back({b, m, d});
        std::erase_if(fan(b), [&, first = t0, second = t1](int t) { return t == first || t == second; });
        fan(b).insert(fan(b).end(), {t2, t2 + 1});
        fan(c).push_back(t2);
        fan(d).push_back(t2 + 1);
        fan(m) = {t0, t1, t2, t2 + 1};
    }

    void collapse(int a, int b) {
        const auto [t0, c] = side(a, b);
        const auto [t1, d] = side(b, a);
        const std::vector<int> ring_a = neighbours(a);
        const std::vector<int> ring_b = neighbours(b);
        std::vector<int> common;
        std::set_intersection(ring_a.begin(), ring_a.end(), ring_b.begin(), ring_b.end(),
                              std::back_inserter(common));
        // The link condition (Dey et al. 1999): otherwise the surface would be pinched.
        if (common.size() != 2 || fan(c).size() <= 3 || fan(d).size() <= 3) return;
        const Vec3 to = projectToCat(0.5 * (position(a) + position(b)));
        const double length = target_length_(to);
        if (glm::distance(to, position(a)) > length) return;
        const Vec3 to_normal = catNormal(to);
        for (const int end : {a, b}) {
            for (const int t : fan(end)) {
                if (t == t0 || t == t1) continue;
                if (!facesOut(triangle(t), end, to, to_normal)) return;
                for (const int v : triangle(t)) {
                    if (v != end && glm::distance(position(v), to) > 1.4 * length) return;
                }
            }
        }
        positions_[static_cast<std::size_t>(a)] = to;
        normals_[static_cast<std::size_t>(a)] = to_normal;
        for (const int v : {a, b, c, d}) {
            std::erase_if(fan(v), [&, first = t0, second = t1](int t) { return t == first || t == second; });
        }
        triangle(t0) = {-1, -1, -1};
        triangle(t1) = {-1, -1, -1};
        for (const int t : fan(b)) {
            replaceCorner(t, b, a);
            fan(a).push_back(t);
        }
        fan(b).clear();
    }

    void flip(int a, int b, bool by_valence) {
        const auto [t0, c] = side(a, b);
        const auto [t1, d] = side(b, a);
        if (fan(a).size() <= 4 || fan(b).size() <= 4 || isEdge(c, d)) return;
        const Vec3& pa = position(a);
        const Vec3& pb = position(b);
        const Vec3& pc = position(c);
        const Vec3& pd = position(d);
        const Vec3 mean = normal(a) + normal(b) + normal(c) + normal(d);
        const auto faces = [&](const Vec3& facing) {
            return glm::dot(facing, mean) > 0.5 * glm::length(facing) * glm::length(mean);
        };
        if (!faces(scaledNormal(pc, pd, pb)) || !faces(scaledNormal(pd, pc, pa))) return;
        const double old_worst = std::max(minAngleCosine(pa, pb, pc), minAngleCosine(pb, pa, pd));
        const double new_worst = std::max(minAngleCosine(pc, pd, pb), minAngleCosine(pd, pc, pa));
        if (by_valence) {
            const auto off = [&](int v, int change) {
                return std::abs(static_cast<int>(fan(v).size()) + change - 6);
            };
            const int before = off(a, 0) + off(b, 0) + off(c, 0) + off(d, 0);
            const int after = off(a, -1) + off(b, -1) + off(c, 1) + off(d, 1);
            if (after >= before || new_worst > std::max(old_worst, 0.9)) return;
        } else if (new_worst >= old_worst - 1e-9) {
            return;
        }
        triangle(t0) = {c, d, b};
        triangle(t1) = {d, c, a};
        std::erase(fan(a), t0);
        std::erase(fan(b), t1);
        fan(c).push_back(t1);
        fan(d).push_back(t0);
    }

    std::vector<Vec3> positions_;
    std::vector<Triangle> triangles_;
    std::vector<std::vector<int>> fans_;
    std::vector<Vec3> normals_;
    const std::function<double(const Vec3&)>& target_length_;
};

} // namespace

Mesh extractSurface(double cell) {
    const Vec3 extent = cat_box_max - cat_box_min;
    const int nx = static_cast<int>(std::ceil(extent.x / cell)) + 1;
    const int ny = static_cast<int>(std::ceil(extent.y / cell)) + 1;
    const int nz = static_cast<int>(std::ceil(extent.z / cell)) + 1;
    const auto id = [&](int x, int y, int z) { return (static_cast<std::int64_t>(z) * ny + y) * nx + x; };
    const auto point = [&](std::int64_t i) {
        const auto x = static_cast<double>(i % nx);
        const auto y = static_cast<double>(i / nx % ny);
        const auto z = static_cast<double>(i / nx / ny);
        return cat_box_min + cell * Vec3{x, y, z};
    };
    std::vector<double> distance(static_cast<std::size_t>(id(nx - 1, ny - 1, nz - 1)) + 1);
    for (std::size_t i = 0; i < distance.size(); ++i) {
        distance[i] = catDistance(point(static_cast<std::int64_t>(i)));
    }

    Mesh mesh;
    std::unordered_map<std::int64_t, int> on_edge;
    const auto vertex = [&](std::int64_t a, std::int64_t b) {
        if (a > b) std::swap(a, b);
        const auto [found, added] = on_edge.try_emplace(a * static_cast<std::int64_t>(distance.size()) + b,
                                                        static_cast<int>(mesh.positions.size()));
        if (added) {
            const double da = distance[static_cast<std::size_t>(a)];
            const double db = distance[static_cast<std::size_t>(b)];
            // Kept off the ends, so that no triangle collapses to a line.
            const double t = std::clamp(da / (da - db), 0.05, 0.95);
            mesh.positions.push_back(glm::mix(point(a), point(b), t));
        }
        return found->second;
    };
    // The six tetrahedra round the cube's main diagonal; corners are numbered by their bits (x, y, z).
    static constexpr std::array<std::array<int, 4>, 6> tetrahedra{
        {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}}};
    for (int z = 0; z + 1 < nz; ++z) {
        for (int y = 0; y + 1 < ny; ++y) {
            for (int x = 0; x + 1 < nx; ++x) {
                for (const auto& corners : tetrahedra) {
                    std::array<std::int64_t, 4> c{};
                    std::vector<std::size_t> in;
                    std::vector<std::size_t> out;
                    for (std::size_t k = 0; k < 4; ++k) {
                        c[k] = id(x + (corners[k] & 1), y + (corners[k] >> 1 & 1), z + (corners[k] >> 2 & 1));
                        (distance[static_cast<std::size_t>(c[k])] < 0.0 ? in : out).push_back(k);
                    }
                    if (in.empty() || out.empty()) continue;
                    Vec3 outward{0.0};
                    for (const std::size_t k : out)
                        outward += point(c[k]) / static_cast<double>(out.size());
                    for (const std::size_t k : in)
                        outward -= point(c[k]) / static_cast<double>(in.size());
                    const auto add = [&](int a, int b, int d) {
                        const auto at = [&](int v) { return mesh.positions[static_cast<std::size_t>(v)]; };
                        const bool faces_out = glm::dot(scaledNormal(at(a), at(b), at(d)), outward) > 0.0;
                        mesh.triangles.push_back(faces_out ? Triangle{a, b, d} : Triangle{a, d, b});
                    };
                    if (in.size() == 2) {
                        const int v0 = vertex(c[in[0]], c[out[0]]);
                        const int v1 = vertex(c[in[0]], c[out[1]]);
                        const int v2 = vertex(c[in[1]], c[out[1]]);
                        const int v3 = vertex(c[in[1]], c[out[0]]);
                        add(v0, v1, v2);
                        add(v0, v2, v3);
                    } else {
                        const bool lone_in = in.size() == 1;
                        const std::size_t lone = lone_in ? in[0] : out[0];
                        const auto& others = lone_in ? out : in;
                        add(vertex(c[lone], c[others[0]]), vertex(c[lone], c[others[1]]),
                            vertex(c[lone], c[others[2]]));
                    }
                }
            }
        }
    }
    if (mesh.triangles.empty()) throw std::runtime_error("cat mesh: the field has no surface in its box");
    keepLargestPart(mesh);
    compact(mesh);
    for (const Vec3& p : mesh.positions)
        mesh.normals.push_back(catNormal(p));
    return mesh;
}

Mesh remesh(const Mesh& mesh, const std::function<double(const Vec3&)>& target_length, int rounds) {
    Remesher work{mesh, target_length};
    for (int round = 0; round < rounds; ++round) {
        work.splitLongEdges();
        work.collapseShortEdges();
        work.flipEdges(true);
        work.relax();
    }
    // The last rounds only better the angles.
    for (int round = 0; round < 4; ++round) {
        work.removeSlivers(20.0);
        work.flipEdges(false);
        work.relax();
    }
    work.flipEdges(false);
    return work.result();
}

MeshReport inspect(const Mesh& mesh) {
    MeshReport report;
    const auto vertices = static_cast<int>(mesh.positions.size());
    if (mesh.normals.size() != mesh.positions.size())
        throw std::runtime_error("cat mesh: a normal is missing");
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        const Vec3& n = mesh.normals[v];
        const Vec3& p = mesh.positions[v];
        if (!std::isfinite(p.x + p.y + p.z) || !(std::abs(glm::length(n) - 1.0) < 1e-6)) {
            throw std::runtime_error("cat mesh: vertex " + std::to_string(v) +
                                     " has no finite position or no unit normal");
        }
        report.max_surface_distance = std::max(report.max_surface_distance, std::abs(catDistance(p)));
    }
    std::map<std::pair<int, int>, int> directed;
    std::vector<std::vector<std::pair<int, int>>> fans(mesh.positions.size());
    double angle_sum = 0.0;
    int below_30 = 0;
    report.min_angle_deg = 180.0;
    for (const Triangle& t : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            if (t[k] < 0 || t[k] >= vertices) throw std::runtime_error("cat mesh: an index is out of range");
            ++directed[{t[k], t[(k + 1) % 3]}];
            fans[static_cast<std::size_t>(t[k])].emplace_back(t[(k + 1) % 3], t[(k + 2) % 3]);
        }
        const auto at = [&](std::size_t k) { return mesh.positions[static_cast<std::size_t>(t[k])]; };
        const Vec3 facing = scaledNormal(at(0), at(1), at(2));
        report.area += 0.5 * glm::length(facing);
        report.volume += glm::dot(at(0), glm::cross(at(1), at(2))) / 6.0;
        const double angle_deg = glm::degrees(std::acos(std::min(1.0, minAngleCosine(at(0), at(1), at(2)))));
        if (angle_deg < report.min_angle_deg) {
            report.min_angle_deg = angle_deg;
            report.sharpest_at = at(0);
        }
        angle_sum += angle_deg;
        if (angle_deg < 30.0) ++below_30;
        for (std::size_t k = 0; k < 3; ++k) {
            const double agreement = glm::dot(facing, mesh.normals[static_cast<std::size_t>(t[k])]);
            report.worst_normal_agreement =
                std::min(report.worst_normal_agreement, agreement / std::max(glm::length(facing), 1e-30));
        }
    }
    for (const auto& [edge, count] : directed) {
        if (edge.first == edge.second || count != 1 || !directed.contains({edge.second, edge.first})) {
            throw std::runtime_error("cat mesh: the edge of vertices " + std::to_string(edge.first) +
                                     " and " + std::to_string(edge.second) +
                                     " is not shared by two opposed triangles");
        }
    }
    for (std::size_t v = 0; v < fans.size(); ++v) {
        // Walking the ring once must meet every triangle of the vertex.
        if (fans[v].empty()) throw std::runtime_error("cat mesh: vertex " + std::to_string(v) + " is unused");
        std::map<int, int> next(fans[v].begin(), fans[v].end());
        std::size_t steps = 0;
        int at = fans[v].front().first;
        do {
            at = next.at(at);
            ++steps;
        } while (at != fans[v].front().first && steps <= fans[v].size());
        if (steps != fans[v].size()) {
            throw std::runtime_error("cat mesh: vertex " + std::to_string(v) + " joins several fans");
        }
    }
    Mesh part = mesh;
    while (!part.triangles.empty()) {
        Mesh largest = part;
        keepLargestPart(largest);
        std::vector<Triangle> rest;
        std::map<Triangle, bool> gone;
        for (const Triangle& t : largest.triangles)
            gone[t] = true;
        for (const Triangle& t : part.triangles) {
            if (!gone.contains(t)) rest.push_back(t);
        }
        part.triangles = std::move(rest);
        ++report.components;
    }
    report.euler_characteristic =
        vertices - static_cast<int>(directed.size() / 2) + static_cast<int>(mesh.triangles.size());
    report.mean_min_angle_deg = angle_sum / static_cast<double>(mesh.triangles.size());
    report.share_below_30_deg = below_30 / static_cast<double>(mesh.triangles.size());
    return report;
}

} // namespace bake
