// Environment light: what each method costs for how close it comes to integrals over every pixel of the sky.
#include "charts/environment.hpp"

#include "09_environment_light/brdf_table.hpp"
#include "charts/chart.hpp"
#include "charts/frames.hpp"
#include "rung/resources.hpp"
#include "support/choices.hpp"
#include "truth/environment_reference.hpp"

#include <cmath>
#include <iterator>
#include <set>
#include <string>
#include <vector>

namespace gll::charts::environment {
namespace {

namespace fs = std::filesystem;

constexpr glm::ivec2 size{320, 240};
constexpr std::size_t ball_count = std::size(environment_light::ball_roughnesses);
constexpr std::size_t first_clay_ball = 2 * ball_count;

struct Method {
    std::string name;
    Set set;
    std::string mark = {};
};

Set joined(Set set, const Set& more) {
    for (const auto& [name, value] : more)
        set[name] = value;
    return set;
}

const Set prefiltered{{"environment_specular", "prefiltered"}, {"environment_brdf", "table"}};
const Set with_sun = joined(prefiltered, {{"environment_sun", "on"}, {"prefilter_samples", "32"}});

const std::vector<Method> glossy = {
    {"one fetch", {{"environment_brdf", "table"}}, "the original's fetch"},
    {"prefiltered", prefiltered},
    {"prefiltered, sun a light", with_sun, "recommended"},
    {"the same, cube", joined(with_sun, {{"environment_layout", "cube"}})},
    {"the same, octahedral", joined(with_sun, {{"environment_layout", "octahedral"}})}};

const std::vector<Method> matt = {{"raw", {}, "the original"},
                                  {"mip", {{"environment_diffuse", "mip"}}},
                                  {"sh9", {{"environment_diffuse", "sh9"}}},
                                  {"sh9_windowed", {{"environment_diffuse", "sh9_windowed"}}},
                                  {"sh9_sun", {{"environment_diffuse", "sh9_sun"}}, "recommended"}};

const std::vector<Method> shares = {{"original", {}, "the original"},
                                    {"table 16", {{"environment_brdf", "table"}, {"brdf_table_size", "16"}}},
                                    {"table 32", {{"environment_brdf", "table"}}, "recommended"},
                                    {"table 64", {{"environment_brdf", "table"}, {"brdf_table_size", "64"}}},
                                    {"karis", {{"environment_brdf", "karis"}}},
                                    {"lazarov", {{"environment_brdf", "lazarov"}}}};

const std::vector<Method> energies = {
    {"energy fdez_aguera", {{"environment_brdf", "table"}, {"environment_energy", "fdez_aguera"}}},
    {"energy turquin", {{"environment_brdf", "table"}, {"environment_energy", "turquin"}}}};

constexpr const char* sample_counts[] = {"16", "32", "64", "128", "256"};

void requireAll(const fs::path& programs) {
    const fs::path rung = programs / "09_environment_light";
    std::set<std::string> names;
    for (const Method& method : matt)
        names.insert(method.name);
    test::requireCovered(rung, "environment_diffuse", names);
    test::requireCovered(rung, "environment_brdf", {"original", "table", "karis", "lazarov"});
    test::requireCovered(rung, "brdf_table_size", {"16", "32", "64"});
    test::requireCovered(rung, "environment_layout", {"equirectangular", "cube", "octahedral"});
    test::requireCovered(rung, "environment_energy", {"none", "fdez_aguera", "turquin"});
}

double mapBytes(const Set& set) {
    if (!set.contains("environment_specular")) return 1024 * 512 * 6;
    double bytes = 0; // as Environment::bytes() counts them
    const auto layout = set.find("environment_layout");
    const double texels = layout == set.end()        ? 1024 * 512
                          : layout->second == "cube" ? 6 * 256 * 256
                                                     : 512 * 512;
    for (int level = 0; level <= 5; ++level)
        bytes += texels / std::pow(4, level) * 6;
    return bytes;
}

} // namespace

void measureCosts(const fs::path& programs, const fs::path& costs_csv) {
    requireAll(programs);
    std::vector<Set> sets;
    Table table{{"method", "cost_cu"}, {}};
    const auto ask = [&](const std::string& prefix, const std::vector<Method>& methods) {
        for (const Method& method : methods) {
            sets.push_back(method.set);
            table.rows.push_back({prefix + method.name});
        }
    };
    ask("glossy ", glossy);
    ask("matt ", matt);
    ask("share ", shares);
    ask("", energies);
    const auto reports = costs(programs / "09_environment_light", sets, size);
    for (std::size_t i = 0; i < reports.size(); ++i)
        for (const auto& pass : reports[i].at("passes"))
            if (pass.at("name") == "balls") table.rows[i].push_back(decimals(pass.at("cu"), 3));
    writeCsv(costs_csv, table);
}

void drawCharts(const fs::path& programs, const fs::path& costs_csv, const fs::path& folder) {
    requireAll(programs);
    const Costs costs(costs_csv);
    const fs::path rung = programs / "09_environment_light";
    const fs::path sky_file = Resources().find("assets/sky/sky.hdr");
    const truth::SkyReference sky(loadImage(sky_file));
    const Image cut = sky.cutAt(8);
    const test::TemporaryFolder temporary;
    saveImage(temporary / "sky.exr", cut);
    const truth::SkyReference sunless(cut);

    Frames frames(rung);
    for (const Method& method : glossy)
        frames.ask(method.set, size, "hdr");
    for (const Method& method : matt)
        for (const char* yaw : {"0", "180"})
            frames.ask(joined(method.set, {{"view", "irradiance"}, {"camera_yaw_deg", yaw}}), size, "hdr");
    for (const Method& method : shares)
        frames.ask(joined(method.set, {{"sky", "furnace"}}), size, "hdr");
    frames.run();
    Frames stored(rung, {"--environment", (temporary / "sky.exr").string()});
    for (const char* filtered : {"on", "off"})
        for (const char* samples : sample_counts)
            stored.ask(joined(with_sun, {{"prefilter_samples", samples},
                                         {"prefilter_filtered", filtered},
                                         {"view", "radiance"}}),
                       size, "hdr");
    stored.run();
    std::vector<measure::ColorImage> images;
    for (std::size_t i = 0; i < glossy.size() + 2 * matt.size() + shares.size(); ++i)
        images.push_back(frames.read(i));
    std::vector<measure::ColorImage> radiances;
    for (std::size_t i = 0; i < 2 * std::size(sample_counts); ++i)
        radiances.push_back(stored.read(i));

    // glossy, both sums; and how far off two exact sums are
    std::vector<Point> by_roughness;
    Table glossy_table{{"method", "roughness", "RMS %", "bias %", "note"}, {}};
    std::vector<std::vector<truth::EnvironmentError>> errors(
        glossy.size() + 1, std::vector<truth::EnvironmentError>(ball_count));
    std::vector<truth::EnvironmentError> all(glossy.size() + 1);
    for (std::size_t ball = 0; ball < ball_count; ++ball) {
        const double roughness = environment_light::ball_roughnesses[ball];
        for (const truth::BallPixel& pixel : truth::ballPixels(ball, size, 5)) {
            const glm::dvec3 gathered =
                roughness == 0 ? sky.radiance(pixel.mirrored) : sky.lobe(pixel.mirrored, roughness);
            const glm::dvec3 expected =
                roughness == 0 ? gathered : sky.reflected(pixel.normal, pixel.to_camera, roughness, 1);
            for (std::size_t i = 0; i < glossy.size(); ++i) {
                errors[i][ball].add(images[i], pixel, expected);
                all[i].add(images[i], pixel, expected);
            }
            const glm::dvec2 both =
                environment_light::brdfScaleAndBias(glm::dot(pixel.normal, pixel.to_camera), roughness, 1024);
            measure::ColorImage exact(1, 1, gathered * (both.x + both.y));
            truth::BallPixel first = pixel;
            first.x = first.y = 0;
            errors.back()[ball].add(exact, first, expected);
            all.back().add(exact, first, expected);
        }
    }
    for (std::size_t i = 0; i <= glossy.size(); ++i)
        for (std::size_t ball = 0; ball < ball_count; ++ball) {
            const std::string name = i < glossy.size() ? glossy[i].name : "two exact sums";
            const double roughness = environment_light::ball_roughnesses[ball];
            const truth::EnvironmentError& error = errors[i][ball];
            glossy_table.rows.push_back({name, shortNumber(roughness), shortNumber(error.rmsPercent()),
                                         shortNumber(error.biasPercent()),
                                         i < glossy.size() ? glossy[i].mark : ""});
            // a mirror is exact; cube and octahedron are as equirectangular
            if (ball > 0 && !(i < glossy.size() && glossy[i].set.contains("environment_layout")))
                by_roughness.push_back({name, "", roughness, error.rmsPercent(),
                                        i < glossy.size() && ball == 3 ? glossy[i].mark : "", true, false,
                                        i < glossy.size() ? std::optional(glossy[i].set) : std::nullopt});
        }
    writeCsv(folder / "environment_glossy.csv", glossy_table);
    drawChart(folder / "environment_glossy.svg",
              {.title = "Glossy metal under a sky with a sun: how far off?",
               .subtitle = "white metal, one bounce, brdf table of 32, 320x240",
               .x = "roughness",
               .y = "RMS error, % of the mean truth",
               .log_y = true,
               .floor = 0.3,
               .x_is_cost = false,
               .rung = rung.filename()},
              by_roughness);

    Table costs_table{{"method", "bytes", "cost cu", "RMS %", "bias %", "note"}, {}};
    for (std::size_t i = 0; i < glossy.size(); ++i)
        costs_table.rows.push_back({glossy[i].name, decimals(mapBytes(glossy[i].set), 0),
                                    decimals(costs.of("glossy " + glossy[i].name, "cost_cu"), 2),
                                    shortNumber(all[i].rmsPercent()), shortNumber(all[i].biasPercent()),
                                    glossy[i].mark});
    writeCsv(folder / "environment_maps.csv", costs_table);

    // matt
    std::vector<Point> matt_points;
    Table matt_table{{"method", "RMS %", "bias %", "cost cu", "note"}, {}};
    std::vector<truth::EnvironmentError> matt_errors(matt.size());
    for (std::size_t side = 0; side < 2; ++side)
        for (const truth::BallPixel& pixel : truth::ballPixels(3, size, 4, side == 0 ? 0 : 180)) {
            const glm::dvec3 expected = sky.irradiance(pixel.normal);
            for (std::size_t i = 0; i < matt.size(); ++i)
                matt_errors[i].add(images[glossy.size() + 2 * i + side], pixel, expected);
        }
    for (std::size_t i = 0; i < matt.size(); ++i) {
        const double cost = costs.of("matt " + matt[i].name, "cost_cu");
        matt_table.rows.push_back({matt[i].name, shortNumber(matt_errors[i].rmsPercent()),
                                   shortNumber(matt_errors[i].biasPercent()), decimals(cost, 2),
                                   matt[i].mark});
        matt_points.push_back(
            {matt[i].name, "", cost, matt_errors[i].rmsPercent(), matt[i].mark, true, false, matt[i].set});
    }
    writeCsv(folder / "environment_matt.csv", matt_table);
    drawChart(folder / "environment_matt.svg",
              {.title = "Matt surfaces: what does a pixel cost, and how far off is it?",
               .subtitle = "the sky with its sun, normals all round, 320x240",
               .x = "cost of the balls' pass, copies (cu)",
               .y = "RMS error of irradiance, % of the mean",
               .log_y = true,
               .floor = 0.1,
               .rung = rung.filename()},
              matt_points);

    // what is stored, by samples
    std::vector<Point> sample_points;
    Table sample_table{{"samples", "filtered, RMS %", "finest level, RMS %"}, {}};
    std::vector<truth::EnvironmentError> stored_errors(radiances.size());
    for (std::size_t ball = 1; ball < ball_count; ++ball)
        for (const truth::BallPixel& pixel : truth::ballPixels(ball, size, 6)) {
            const glm::dvec3 expected =
                sunless.lobe(pixel.mirrored, environment_light::ball_roughnesses[ball]);
            for (std::size_t i = 0; i < radiances.size(); ++i)
                stored_errors[i].add(radiances[i], pixel, expected);
        }
    const std::size_t count = std::size(sample_counts);
    for (std::size_t i = 0; i < count; ++i)
        sample_table.rows.push_back({sample_counts[i], shortNumber(stored_errors[i].rmsPercent()),
                                     shortNumber(stored_errors[count + i].rmsPercent())});
    for (std::size_t i = 0; i < 2 * count; ++i)
        sample_points.push_back({i < count ? "filtered by mip levels" : "samples of the finest level",
                                 sample_counts[i % count], std::stod(sample_counts[i % count]),
                                 stored_errors[i].rmsPercent(), i == 1 ? "recommended" : "", true, false,
                                 joined(with_sun, {{"prefilter_samples", sample_counts[i % count]},
                                                   {"prefilter_filtered", i < count ? "on" : "off"}})});
    writeCsv(folder / "environment_samples.csv", sample_table);
    drawChart(folder / "environment_samples.svg",
              {.title = "Prefiltering: how many samples a texel?",
               .subtitle = "the sky without its sun, roughness 0.05 to 1, 320x240",
               .x = "samples",
               .y = "RMS error of what is stored, % of the mean",
               .log_y = true,
               .floor = 0.1,
               .log_x = true,
               .rung = rung.filename()},
              sample_points);

    // how much is reflected
    Table share_table{
        {"method", "f0 1, RMS", "f0 0.04, RMS", "f0 1, worst", "f0 0.04, worst", "bytes", "cost cu", "note"},
        {}};
    for (std::size_t i = 0; i < shares.size(); ++i) {
        const measure::ColorImage& image = images[glossy.size() + 2 * matt.size() + i];
        double squares[2] = {0, 0};
        double worst[2] = {0, 0};
        int pixels[2] = {0, 0};
        for (std::size_t ball = 0; ball < ball_count; ++ball) {
            const double roughness = environment_light::ball_roughnesses[ball];
            for (const std::size_t row : {std::size_t(0), std::size_t(1)})
                for (const truth::BallPixel& pixel :
                     truth::ballPixels(ball + row * first_clay_ball, size, 5)) {
                    const glm::dvec2 both = environment_light::brdfScaleAndBias(
                        glm::dot(pixel.normal, pixel.to_camera), roughness, 1024);
                    const double albedo =
                        row == 0 ? 0 : double(environment_light::balls()[first_clay_ball].albedo.g);
                    const double off =
                        image.at(pixel.x, pixel.y).g - albedo - ((row == 0 ? 1 : 0.04) * both.x + both.y);
                    squares[row] += off * off;
                    worst[row] = std::max(worst[row], std::abs(off));
                    ++pixels[row];
                }
        }
        const std::string bytes = shares[i].name.starts_with("table")
                                      ? std::to_string(std::stoi(shares[i].name.substr(6)) *
                                                       std::stoi(shares[i].name.substr(6)) * 4)
                                      : "0";
        share_table.rows.push_back(
            {shares[i].name, shortNumber(std::sqrt(squares[0] / pixels[0])),
             shortNumber(std::sqrt(squares[1] / pixels[1])), shortNumber(worst[0]), shortNumber(worst[1]),
             bytes, decimals(costs.of("share " + shares[i].name, "cost_cu"), 2), shares[i].mark});
    }
    writeCsv(folder / "environment_brdf.csv", share_table);
}

} // namespace gll::charts::environment
