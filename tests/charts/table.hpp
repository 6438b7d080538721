// Tables as CSV, and numbers as tables have them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gll::charts {

// A table to write as CSV, numbers in few digits so that the last bit of a float does not change a committed
// file.
struct Table {
    std::vector<std::string> columns;
    std::vector<std::vector<std::string>> rows;
};
void writeCsv(const std::filesystem::path& file, const Table& table);
// Throws std::runtime_error where it cannot be read or a row has another number of cells.
Table readCsv(const std::filesystem::path& file);

// A table of costs as a family's measure function wrote it: the first column names what was measured.
class Costs {
  public:
    explicit Costs(std::filesystem::path csv);
    // Throws std::runtime_error naming the file and what it lacks.
    double of(const std::string& name, const std::string& column) const;

  private:
    std::filesystem::path file_;
    Table table_;
};

// Numbers as tables have them, never "-0": three significant digits, or so many decimals.
std::string shortNumber(double value);
std::string decimals(double value, int count);

} // namespace gll::charts
