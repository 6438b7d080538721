// Writing and reading CSV.
#include "charts/table.hpp"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <utility>

namespace gll::charts {
namespace {

void write(const std::filesystem::path& file, const std::string& text) {
    std::ofstream stream(file, std::ios::binary);
    stream << text;
    stream.close();
    if (!stream) throw std::runtime_error(file.string() + ": cannot be written");
}

} // namespace

void writeCsv(const std::filesystem::path& file, const Table& table) {
    std::string text;
    const auto line = [&](const std::vector<std::string>& cells) {
        for (std::size_t i = 0; i < cells.size(); ++i)
            text += (i > 0 ? "," : "") +
                    (cells[i].find(',') == std::string::npos ? cells[i] : "\"" + cells[i] + "\"");
        text += "\n";
    };
    line(table.columns);
    for (const auto& row : table.rows)
        line(row);
    write(file, text);
}

Table readCsv(const std::filesystem::path& file) {
    std::ifstream stream(file);
    if (!stream) throw std::runtime_error(file.string() + ": cannot be read");
    Table table;
    std::string text;
    while (std::getline(stream, text)) {
        std::vector<std::string> cells(1);
        bool in_quotes = false;
        for (const char c : text) {
            if (c == '"')
                in_quotes = !in_quotes;
            else if (c == ',' && !in_quotes)
                cells.emplace_back();
            else
                cells.back() += c;
        }
        if (table.columns.empty())
            table.columns = cells;
        else if (cells.size() == table.columns.size())
            table.rows.push_back(cells);
        else
            throw std::runtime_error(file.string() + ": not as many cells as columns in \"" + text + "\"");
    }
    return table;
}

Costs::Costs(std::filesystem::path csv) : file_(std::move(csv)), table_(readCsv(file_)) {}

double Costs::of(const std::string& name, const std::string& column) const {
    const auto place = std::find(table_.columns.begin(), table_.columns.end(), column);
    for (const auto& row : table_.rows)
        if (row[0] == name && place != table_.columns.end())
            return std::stod(row[static_cast<std::size_t>(place - table_.columns.begin())]);
    throw std::runtime_error(file_.string() + ": has no " + column + " of \"" + name +
                             "\"; measure the costs anew");
}

std::string shortNumber(double value) {
    char buffer[40];
    std::snprintf(buffer, sizeof buffer, "%.3g", value == 0 ? 0.0 : value);
    return buffer;
}

std::string decimals(double value, int count) {
    char buffer[400]; // the longest double has 309 digits before its point
    std::snprintf(buffer, sizeof buffer, "%.*f", count, value);
    const std::string text = buffer;
    return text[0] == '-' && text.find_first_not_of("-0.") == std::string::npos ? text.substr(1) : text;
}

} // namespace gll::charts
