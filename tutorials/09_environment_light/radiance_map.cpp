// Integrals over a picture of the light from all round.
#include "radiance_map.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <sstream>
#include <stdexcept>

namespace gll::environment_light {
namespace {

constexpr double pi = std::numbers::pi;
constexpr float largest_half_float = 65504;

std::size_t countOf(int width, int height) {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
}

double luminance(const glm::dvec3& color) { return glm::dot(color, glm::dvec3(0.2126, 0.7152, 0.0722)); }

// Each row averaged along itself over as many pixels as are as wide there as one is at the equator.
void widenAtPoles(RadianceMap& map) {
    std::vector<glm::dvec3> sums(static_cast<std::size_t>(map.width) + 1);
    for (int row = 0; row < map.height; ++row) {
        const double wide =
            std::min(1 / std::sin((row + 0.5) / map.height * pi), static_cast<double>(map.width));
        glm::vec3* pixels = &map.pixels[countOf(map.width, row)];
        for (int i = 0; i < map.width; ++i)
            sums[static_cast<std::size_t>(i) + 1] = sums[static_cast<std::size_t>(i)] + glm::dvec3(pixels[i]);
        // of everything from the row's beginning to x, which may lie beyond its ends
        const auto upTo = [&](double x) {
            const double turns = std::floor(x / map.width);
            const double within = x - turns * map.width;
            const auto whole = std::min(static_cast<std::size_t>(within), sums.size() - 2);
            return turns * sums.back() +
                   glm::mix(sums[whole], sums[whole + 1], within - static_cast<double>(whole));
        };
        for (int i = 0; i < map.width; ++i)
            pixels[i] = glm::vec3((upTo(i + 0.5 + 0.5 * wide) - upTo(i + 0.5 - 0.5 * wide)) / wide);
    }
}

// Each pixel is the mean over its own solid angle, of pixels of which it may have a part: sizes need not be
// even.
RadianceMap halved(const RadianceMap& map) {
    RadianceMap half{.width = std::max(map.width / 2, 1), .height = std::max(map.height / 2, 1)};
    half.pixels.resize(countOf(half.width, half.height));
    const double wide = double(map.width) / half.width; // pixels
    const double high = double(map.height) / half.height;
    for (int y = 0; y < half.height; ++y)
        for (int x = 0; x < half.width; ++x) {
            glm::dvec3 sum(0);
            double weights = 0;
            for (int row = static_cast<int>(y * high); row < map.height && row < (y + 1) * high; ++row) {
                const double top = std::max(double(row), y * high) / map.height * pi;
                const double bottom = std::min(row + 1.0, (y + 1) * high) / map.height * pi;
                const double band = std::cos(top) - std::cos(bottom);
                for (int column = static_cast<int>(x * wide); column < map.width && column < (x + 1) * wide;
                     ++column) {
                    const double weight =
                        band * (std::min(column + 1.0, (x + 1) * wide) - std::max(double(column), x * wide));
                    sum += weight * glm::dvec3(map.at(column, row));
                    weights += weight;
                }
            }
            half.pixels[countOf(half.width, y) + static_cast<std::size_t>(x)] = glm::vec3(sum / weights);
        }
    return half;
}

// A direction of the lobe, about z, and which level it reads.
struct Sample {
    glm::vec3 light;
    std::size_t level;
};

// excerpt: samples
// Rings about the normal that gather equal parts of the lobe, a sample on each, a golden angle further than
// the last. Each stands for a solid angle of 1 / (samples * density), and reads the level whose pixels are
// about as large, so that few suffice (Krivanek and Colbert 2008, "Real-Time Shading with Filtered Importance
// Sampling").
std::vector<Sample> samplesOf(const std::vector<RadianceMap>& chain, double roughness,
                              const Prefilter& prefilter) {
    constexpr double golden_angle_rad = 2.3998277;
    // Half a level finer, since bilinear reading widens pixels. A sun that is in the map would be seen or
    // missed then: it wants samples that overlap.
    const double level_bias = prefilter.has_sun ? 1.0 : -0.5;
    const double pixel_solid_angle = 2 * pi * pi / (double(chain[0].width) * chain[0].height);
    const double whole = lobeIntegral(roughness);
    std::vector<Sample> samples;
    for (int i = 0; i < prefilter.samples; ++i) {
        double inner = 1; // cosines between which the ring is found
        double outer = 0;
        const double share = (i + 0.5) / prefilter.samples * whole;
        for (int step = 0; step < 48; ++step) {
            const double middle = 0.5 * (inner + outer);
            (lobeIntegral(roughness, middle) < share ? inner : outer) = middle;
        }
        const double cosine = outer;
        const double sine = std::sqrt(1 - cosine * cosine);
        const double around_rad = i * golden_angle_rad;
        const double solid_angle = whole / (prefilter.samples * lobe(cosine, roughness));
        const double level = 0.5 * std::log2(solid_angle / pixel_solid_angle) + level_bias;
        const double last = prefilter.filtered ? static_cast<double>(chain.size() - 1) : 0;
        samples.push_back({glm::vec3(sine * std::cos(around_rad), sine * std::sin(around_rad), cosine),
                           static_cast<std::size_t>(std::clamp(std::round(level), 0.0, last))});
    }
    return samples;
}
// end excerpt

// Axes across a normal, along its circle of latitude and along its meridian: the same, turned, all round a
// circle.
struct Frame {
    glm::vec3 x, y;
    explicit Frame(glm::vec3 normal) : x(normal.z, 0, -normal.x), y(0) {
        const float length = glm::length(x);
        x = length > 1e-6F ? x / length : glm::vec3(1, 0, 0);
        y = glm::cross(normal, x);
    }
};

} // namespace

RadianceMap radianceMap(const Image& image, const std::filesystem::path& path, Warnings& warnings) {
    if (!std::holds_alternative<std::vector<float>>(image.pixels))
        throw std::runtime_error(path.string() + ": an environment must be .hdr or .exr, in linear light");
    if (image.cube_map)
        throw std::runtime_error(path.string() + ": is a cube map (envmap=cube), convert it to latitude and "
                                                 "longitude, one picture twice as wide as high");
    const auto& from = std::get<std::vector<float>>(image.pixels);
    const auto channels = static_cast<std::size_t>(image.channels);
    RadianceMap map{.width = image.width, .height = image.height, .pixels = {}};
    map.pixels.reserve(from.size() / channels);
    std::size_t cut = 0;
    float brightest = 0;
    for (std::size_t i = 0; i < from.size(); i += channels) {
        glm::vec3 pixel;
        for (std::size_t c = 0; c < 3; ++c) {
            const float value = from[i + (channels < 3 ? 0 : c)];
            if (std::isnan(value))
                throw std::runtime_error(path.string() + ": holds a value that is not a number");
            pixel[static_cast<int>(c)] = std::clamp(value, 0.0F, largest_half_float);
            brightest = std::max(brightest, value);
            cut += value > largest_half_float ? 1 : 0;
        }
        map.pixels.push_back(pixel);
    }
    if (cut > 0) {
        std::ostringstream line;
        line << path.string() << ": " << cut << " values are cut off at " << largest_half_float
             << ", the largest half float, of up to " << brightest;
        warnings.add({line.str()});
    }
    return map;
}

glm::dvec3 directionOf(double u, double v) {
    const double around = (u - 0.5) * 2 * pi;
    const double down = v * pi;
    return {std::sin(down) * std::cos(around), std::cos(down), std::sin(down) * std::sin(around)};
}

double solidAngle(const RadianceMap& map, int row) {
    return (std::cos(row * pi / map.height) - std::cos((row + 1) * pi / map.height)) * 2 * pi / map.width;
}

std::vector<RadianceMap> mipChain(const RadianceMap& map) {
    std::vector<RadianceMap> chain = {map};
    while (chain.back().width > 1 || chain.back().height > 1) {
        chain.push_back(halved(chain.back()));
        widenAtPoles(chain.back());
    }
    return chain;
}

glm::vec2 uvOf(glm::vec3 direction) {
    constexpr float pi_f = std::numbers::pi_v<float>;
    return {std::atan2(direction.z, direction.x) / (2 * pi_f) + 0.5F,
            std::acos(std::clamp(direction.y, -1.0F, 1.0F)) / pi_f};
}

glm::vec3 lookUp(const RadianceMap& map, glm::vec2 uv) {
    const float x = uv.x * static_cast<float>(map.width) - 0.5F;
    const float y = uv.y * static_cast<float>(map.height) - 0.5F;
    const float left = std::floor(x);
    const float above = std::floor(y);
    const auto around = [&](int column) {
        column %= map.width;
        return column < 0 ? column + map.width : column;
    };
    const int x0 = around(static_cast<int>(left));
    const int x1 = x0 + 1 == map.width ? 0 : x0 + 1;
    const int y0 = std::clamp(static_cast<int>(above), 0, map.height - 1);
    const int y1 = std::clamp(static_cast<int>(above) + 1, 0, map.height - 1);
    const float fx = x - left;
    const float fy = y - above;
    return (1 - fy) * ((1 - fx) * map.at(x0, y0) + fx * map.at(x1, y0)) +
           fy * ((1 - fx) * map.at(x0, y1) + fx * map.at(x1, y1));
}

Irradiance irradianceCoefficients(const RadianceMap& map) {
    Irradiance sums{};
    // Constants of the basis, squared (once to project, once to evaluate), times what the cosine lobe leaves
    // of each band, over pi: 1, 2/3, 1/4.
    constexpr double band0 = 1 / (4 * pi);
    constexpr double band1 = 3 / (4 * pi) * 2 / 3;
    constexpr double band2 = 15 / (4 * pi) / 4;
    constexpr std::array<double, 9> factors = {band0, band1,      band1, band1,    band2,
                                               band2, band2 / 12, band2, band2 / 4};
    // Large pixels in parts: the basis changes within them.
    const int parts_across = std::max(128 / map.width, 1);
    const int parts_down = std::max(64 / map.height, 1);
    const int width = map.width * parts_across;
    const int height = map.height * parts_down;
    std::vector<glm::dvec2> around; // cosine and sine of each column's azimuth
    for (int column = 0; column < width; ++column) {
        const double azimuth_rad = ((column + 0.5) / width - 0.5) * 2 * pi;
        around.emplace_back(std::cos(azimuth_rad), std::sin(azimuth_rad));
    }
    for (int row = 0; row < height; ++row) {
        const double solid_angle =
            (std::cos(row * pi / height) - std::cos((row + 1) * pi / height)) * 2 * pi / width;
        const double down = (row + 0.5) / height * pi;
        const double sine = std::sin(down);
        const double cosine = std::cos(down);
        for (int column = 0; column < width; ++column) {
            const glm::dvec2& turned = around[static_cast<std::size_t>(column)];
            const glm::dvec3 n(sine * turned.x, cosine, sine * turned.y);
            const glm::dvec3 light =
                solid_angle * glm::dvec3(map.at(column / parts_across, row / parts_down));
            const std::array<double, 9> basis = {
                1, n.y, n.z, n.x, n.x * n.y, n.y * n.z, 3 * n.z * n.z - 1, n.x * n.z, n.x * n.x - n.y * n.y};
            for (std::size_t i = 0; i < basis.size(); ++i)
                sums[i] += light * basis[i];
        }
    }
    for (std::size_t i = 0; i < sums.size(); ++i)
        sums[i] *= factors[i];
    return sums;
}

glm::dvec3 irradianceAt(const Irradiance& c, glm::dvec3 n) {
    return c[0] + c[1] * n.y + c[2] * n.z + c[3] * n.x + c[4] * n.x * n.y + c[5] * n.y * n.z +
           c[6] * (3 * n.z * n.z - 1) + c[7] * n.x * n.z + c[8] * (n.x * n.x - n.y * n.y);
}

Irradiance windowed(const Irradiance& coefficients) {
    const auto smoothed = [&](double k) {
        Irradiance result = coefficients;
        for (std::size_t i = 1; i < result.size(); ++i)
            result[i] /= i < 4 ? 1 + 4 * k : 1 + 36 * k; // bands 1 and 2
        return result;
    };
    const auto isNegative = [](const Irradiance& candidate) {
        constexpr int rows = 32;
        for (int row = 0; row <= rows; ++row)
            for (int column = 0; column < 2 * rows; ++column) {
                const glm::dvec3 light =
                    irradianceAt(candidate, directionOf((column + 0.5) / (2 * rows), double(row) / rows));
                if (light.r < 0 || light.g < 0 || light.b < 0) return true;
            }
        return false;
    };
    if (!isNegative(coefficients)) return coefficients;
    double too_little = 0;
    double enough = 1; // what is then left of a point light's band 1 is too small to be below 0 anywhere
    for (int i = 0; i < 16; ++i) {
        const double middle = 0.5 * (too_little + enough);
        (isNegative(smoothed(middle)) ? too_little : enough) = middle;
    }
    return smoothed(enough);
}

// excerpt: sun
// Pixels within 3 degrees of the middle of the brightest light, as far as they are brighter than the mean of
// the ring from 3 to 6 degrees.
SunAndSky withoutSun(const RadianceMap& map) {
    const double near = std::cos(3 * pi / 180);
    const double far = std::cos(6 * pi / 180);
    SunAndSky result{.sun = std::nullopt, .sky = map};
    glm::dvec3 mean(0);
    double brightest = -1;
    glm::dvec3 middle(0, 1, 0);
    for (int row = 0; row < map.height; ++row) {
        const double share = solidAngle(map, row) / (4 * pi);
        for (int column = 0; column < map.width; ++column) {
            const glm::dvec3 color(map.at(column, row));
            mean += color * share;
            if (luminance(color) <= brightest) continue;
            brightest = luminance(color);
            middle = directionOf((column + 0.5) / map.width, (row + 0.5) / map.height);
        }
    }
    if (brightest <= 10 * luminance(mean)) return result;
    const auto forEach = [&](const auto& visit) {
        for (int row = 0; row < map.height; ++row) {
            if (std::abs(std::acos(std::clamp(middle.y, -1.0, 1.0)) - (row + 0.5) / map.height * pi) > 0.11)
                continue; // more than 6 degrees up or down
            const double solid_angle = solidAngle(map, row);
            for (int column = 0; column < map.width; ++column) {
                const glm::dvec3 direction =
                    directionOf((column + 0.5) / map.width, (row + 0.5) / map.height);
                visit(countOf(map.width, row) + static_cast<std::size_t>(column), direction,
                      glm::dot(direction, middle), solid_angle);
            }
        }
    };
    // The first of equally bright pixels is at a light's rim. From there what is within 3 degrees leads
    // inwards.
    for (int step = 0; step < 3; ++step) {
        glm::dvec3 towards(0);
        forEach([&](std::size_t i, const glm::dvec3& direction, double cosine, double solid_angle) {
            if (cosine > near) towards += solid_angle * luminance(glm::dvec3(map.pixels[i])) * direction;
        });
        middle = glm::normalize(towards);
    }
    glm::dvec3 ring(0);
    double ring_solid_angle = 0;
    forEach([&](std::size_t i, const glm::dvec3&, double cosine, double solid_angle) {
        if (cosine > near || cosine < far) return;
        ring += solid_angle * glm::dvec3(map.pixels[i]);
        ring_solid_angle += solid_angle;
    });
    if (ring_solid_angle == 0) return result; // pixels are too large for a light to be compact
    ring /= ring_solid_angle;
    Sun sun;
    glm::dvec3 light(0);
    glm::dvec3 towards(0);
    double spread = 0;
    forEach([&](std::size_t i, const glm::dvec3& direction, double cosine, double solid_angle) {
        if (cosine <= near) return;
        const glm::dvec3 above = glm::max(glm::dvec3(map.pixels[i]) - ring, glm::dvec3(0));
        if (luminance(above) < 4 * luminance(ring)) return; // its glow is the sky's
        result.sky.pixels[i] = glm::vec3(glm::dvec3(map.pixels[i]) - above);
        light += solid_angle * above;
        towards += solid_angle * luminance(above) * direction;
        // squared angle from the middle, and what a disc as large as the pixel has about its own
        spread += solid_angle * luminance(above) * (2 * (1 - cosine) + solid_angle / (2 * pi));
    });
    if (luminance(light) == 0) return result;
    sun.direction = glm::normalize(towards);
    // about its own direction: less what that is off the middle
    sun.mean_squared_angle =
        std::max(spread / luminance(light) - 2 * (1 - glm::dot(sun.direction, middle)), 0.0);
    sun.irradiance = light / pi;
    result.sun = sun;
    return result;
}
// end excerpt

double lobe(double cosine, double roughness) {
    if (cosine <= 0) return 0;
    const double alpha_squared = std::pow(roughness, 4);
    const double spread =
        0.5 * (1 + cosine) * (alpha_squared - 1) + 1; // of the half-vector: n.h^2 = (1 + n.l) / 2
    return alpha_squared / (pi * spread * spread) / 4 * cosine;
}

double lobeIntegral(double roughness, double least_cosine) {
    const double alpha_squared = std::pow(roughness, 4);
    const double b = 1 - alpha_squared;
    if (b < 1e-6) return 0.25 * (1 - least_cosine * least_cosine); // GGX of alpha 1 is the same everywhere
    // over x = n.h^2 up to 1: alpha^2 (2x - 1) / (1 - bx)^2
    const auto integral = [&](double x) {
        const double y = 1 - b * x;
        return ((2 / b - 1) / y + 2 / b * std::log(y)) / b;
    };
    return alpha_squared * (integral(1) - integral(0.5 * (1 + least_cosine)));
}

std::vector<glm::vec3> prefiltered(const std::vector<RadianceMap>& chain,
                                   const std::vector<glm::vec3>& normals, double roughness,
                                   const Prefilter& prefilter) {
    const std::vector<Sample> samples = samplesOf(chain, roughness, prefilter);
    std::vector<glm::vec3> texels;
    texels.reserve(normals.size());
    for (const glm::vec3& normal : normals) {
        const Frame frame(normal);
        glm::vec3 sum(0);
        for (const Sample& sample : samples)
            sum += lookUp(chain[sample.level], uvOf(sample.light.x * frame.x + sample.light.y * frame.y +
                                                    sample.light.z * normal));
        texels.push_back(sum / float(samples.size()));
    }
    return texels;
}

std::vector<glm::vec3> prefiltered(const std::vector<RadianceMap>& chain, glm::ivec2 size, double roughness,
                                   const Prefilter& prefilter) {
    const std::vector<Sample> samples = samplesOf(chain, roughness, prefilter);
    std::vector<glm::vec3> texels;
    texels.reserve(countOf(size.x, size.y));
    std::vector<glm::vec2> places(samples.size());
    for (int row = 0; row < size.y; ++row) {
        // Along a row samples lie alike, only further round, so where they lie is found once.
        const glm::vec3 first(directionOf(0.5, (row + 0.5) / size.y));
        const Frame frame(first);
        for (std::size_t i = 0; i < samples.size(); ++i) {
            const glm::vec3& light = samples[i].light;
            places[i] = uvOf(light.x * frame.x + light.y * frame.y + light.z * first);
        }
        for (int column = 0; column < size.x; ++column) {
            const float u = (static_cast<float>(column) + 0.5F) / static_cast<float>(size.x) - 0.5F;
            glm::vec3 sum(0);
            for (std::size_t i = 0; i < samples.size(); ++i)
                sum += lookUp(chain[samples[i].level], places[i] + glm::vec2(u, 0));
            texels.push_back(sum / float(samples.size()));
        }
    }
    return texels;
}

std::vector<glm::vec3> cubeDirections(int size) {
    // the middle of a side, and what its s and t grow along: OpenGL 3.3, table 3.21
    struct Side {
        glm::vec3 middle, s, t;
    };
    constexpr Side sides[] = {{{1, 0, 0}, {0, 0, -1}, {0, -1, 0}}, {{-1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
                              {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}},   {{0, -1, 0}, {1, 0, 0}, {0, 0, -1}},
                              {{0, 0, 1}, {1, 0, 0}, {0, -1, 0}},  {{0, 0, -1}, {-1, 0, 0}, {0, -1, 0}}};
    std::vector<glm::vec3> directions;
    directions.reserve(6 * countOf(size, size));
    for (const Side& side : sides)
        for (int row = 0; row < size; ++row)
            for (int column = 0; column < size; ++column) {
                const glm::vec2 p = 2.0F * (glm::vec2(column, row) + 0.5F) / static_cast<float>(size) - 1.0F;
                directions.push_back(glm::normalize(side.middle + p.x * side.s + p.y * side.t));
            }
    return directions;
}

std::vector<glm::vec3> octahedralDirections(int size) {
    std::vector<glm::vec3> directions;
    directions.reserve(countOf(size, size));
    for (int row = 0; row < size; ++row)
        for (int column = 0; column < size; ++column) {
            const glm::vec2 p = 2.0F * glm::vec2(column, row) / static_cast<float>(size - 1) - 1.0F;
            glm::vec3 direction(p, 1 - std::abs(p.x) - std::abs(p.y));
            const float folded = std::max(-direction.z, 0.0F);
            direction.x -= p.x < 0 ? -folded : folded;
            direction.y -= p.y < 0 ? -folded : folded;
            directions.push_back(glm::normalize(direction));
        }
    return directions;
}

} // namespace gll::environment_light
