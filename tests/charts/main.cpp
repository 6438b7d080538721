// charts: measures a family of methods and draws what it costs against how far off it is.
#include "charts/bloom.hpp"
#include "charts/deferred.hpp"
#include "charts/environment.hpp"
#include "charts/exposure.hpp"
#include "charts/formats.hpp"
#include "charts/gbuffer.hpp"
#include "charts/shadow.hpp"
#include "charts/ssao.hpp"
#include "charts/tone.hpp"
#include "support/temporary_folder.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <iterator>
#include <map>
#include <set>
#include <stdexcept>

namespace {
namespace fs = std::filesystem;

struct Family {
    void (*measure)(const fs::path& programs, const fs::path& costs_csv);
    void (*draw)(const fs::path& programs, const fs::path& costs_csv, const fs::path& folder);
};

const std::map<std::string, Family> families = {
    {"bloom", {gll::charts::bloom::measureCosts, gll::charts::bloom::drawCharts}},
    {"environment", {gll::charts::environment::measureCosts, gll::charts::environment::drawCharts}},
    {"deferred", {gll::charts::deferred::measureCosts, gll::charts::deferred::drawCharts}},
    {"exposure", {gll::charts::exposure::measureCosts, gll::charts::exposure::drawCharts}},
    {"formats", {gll::charts::formats::measureCosts, gll::charts::formats::drawCharts}},
    {"gbuffer", {gll::charts::gbuffer::measureCosts, gll::charts::gbuffer::drawCharts}},
    {"shadow", {gll::charts::shadow::measureCosts, gll::charts::shadow::drawCharts}},
    {"ssao", {gll::charts::ssao::measureCosts, gll::charts::ssao::drawCharts}},
    {"tone", {gll::charts::measureToneCosts, gll::charts::drawToneCharts}}};

// The family's charts and tables in a folder; costs are measured, not drawn.
std::set<std::string> filesOf(const std::string& family, const fs::path& folder) {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder)) {
        const std::string name = entry.path().filename();
        if (name.starts_with(family) && name != family + "_costs.csv") names.insert(name);
    }
    return names;
}

// Throws std::runtime_error naming the first file that is not, byte for byte, as it was committed.
void requireSame(const fs::path& fresh, const fs::path& committed, const std::string& family) {
    const std::string advice = "; if what is drawn now is right, run tutorials/pages charts " + family;
    const std::set<std::string> drawn = filesOf(family, fresh);
    for (const std::string& name : filesOf(family, committed))
        if (!drawn.contains(name))
            throw std::runtime_error((committed / name).string() + ": is no longer drawn" + advice +
                                     " and delete it");
    for (const std::string& name : drawn) {
        if (!fs::exists(committed / name))
            throw std::runtime_error((fresh / name).string() + ": has nothing to be compared with in " +
                                     committed.string() + advice);
        if (gll::test::contents(fresh / name) != gll::test::contents(committed / name))
            throw std::runtime_error((committed / name).string() + ": differs from " +
                                     (fresh / name).string() + ", drawn now; look at both" + advice);
    }
}

} // namespace

int main(int argc, char** argv) {
    CLI::App app("Draws the charts of a family of methods from what its rungs render.", "charts");
    std::string family;
    fs::path programs;
    fs::path costs;
    fs::path folder;
    fs::path committed;
    bool measure = false;
    std::vector<std::string> names;
    for (const auto& [name, functions] : families)
        names.push_back(name);
    app.add_option("family", family, "which charts")->required()->check(CLI::IsMember(names));
    app.add_option("--programs", programs, "the folder of the rungs' programs")->required();
    app.add_option("--costs", costs, "the table of costs")->required();
    app.add_option("--out", folder, "the folder to write into")->required()->check(CLI::ExistingDirectory);
    app.add_flag("--measure", measure,
                 "measure the costs anew first, into their table: minutes, under callgrind");
    app.add_option("--compare", committed, "fail unless this folder holds the same charts, byte for byte")
        ->check(CLI::ExistingDirectory);
    CLI11_PARSE(app, argc, argv);
    try {
        if (!committed.empty()) {
            if (fs::equivalent(folder, committed))
                throw std::runtime_error("--compare wants another folder than --out");
            for (const std::string& name : filesOf(family, folder))
                fs::remove(folder / name); // of an earlier run
        }
        if (measure) families.at(family).measure(programs, costs);
        families.at(family).draw(programs, costs, folder);
        if (!committed.empty()) requireSame(folder, committed, family);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "charts: error: %s\n", error.what());
        return 1;
    }
    return 0;
}
