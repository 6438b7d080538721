// charts: measures a family of methods and draws what it costs against how far off it is.
#include "charts/bloom.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>

int main(int argc, char** argv) {
    CLI::App app("Draws the charts of a family of methods from what its rungs render.", "charts");
    std::string family;
    std::filesystem::path programs;
    std::filesystem::path costs;
    std::filesystem::path folder;
    bool measure = false;
    app.add_option("family", family, "which charts")->required()->check(CLI::IsMember({"bloom"}));
    app.add_option("--programs", programs, "the folder of the rungs' programs")->required();
    app.add_option("--costs", costs, "the table of costs")->required();
    app.add_option("--out", folder, "the folder to write into")->required()->check(CLI::ExistingDirectory);
    app.add_flag("--measure", measure,
                 "measure the costs anew first, into their table: minutes, under callgrind");
    CLI11_PARSE(app, argc, argv);
    try {
        if (measure) gll::charts::measureBloomCosts(programs, costs);
        gll::charts::drawBloomCharts(programs, costs, folder);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "charts: error: %s\n", error.what());
        return 1;
    }
    return 0;
}
