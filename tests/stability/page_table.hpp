// The table that a rung's page shows: its methods against the ways they fail, as measured now.
#pragma once

#include "charts/chart.hpp"
#include "charts/frames.hpp"

#include <map>
#include <string>
#include <utility>

namespace gll::stability {

// Of the programs under test, the pages with their tables, and what a run leaves to be looked at.
struct Folders {
    std::filesystem::path programs;
    std::filesystem::path tutorials;
    std::filesystem::path output;
};
extern Folders folders;

// Said where what is expected to fail does not.
inline constexpr const char* news = "known to be bad, and now is not: say so on the page";

// Settings, and others over them.
inline charts::Set operator+(charts::Set left, const charts::Set& right) {
    for (const auto& [name, value] : right)
        left[name] = value;
    return left;
}

class PageTable {
  public:
    explicit PageTable(std::string rung) : rung_(std::move(rung)) {}

    // Methods and failures stand in the order in which they were first named. Numbers come as
    // charts::decimals() and its like make them, so that the last bit of a float does not change a committed
    // file.
    void set(const std::string& method, const std::string& failure, const std::string& number);

    // Writes the table into the output folder, and fails the test unless tutorials/RUNG/charts/stability.csv
    // is the same, byte for byte. Does nothing where only some of the suite's tests have run.
    void check() const;

  private:
    std::string rung_;
    std::vector<std::string> methods_;
    std::vector<std::string> failures_;
    std::map<std::pair<std::string, std::string>, std::string> numbers_;
};

} // namespace gll::stability
