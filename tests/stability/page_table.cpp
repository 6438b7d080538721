// Tables of failures, held to those that are committed.
#include "page_table.hpp"
#include "support/temporary_folder.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <iterator>

namespace gll::stability {
namespace {

void addOnce(std::vector<std::string>& names, const std::string& name) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
}

} // namespace

Folders folders;

void PageTable::set(const std::string& method, const std::string& failure, const std::string& number) {
    addOnce(methods_, method);
    addOnce(failures_, failure);
    numbers_[{method, failure}] = number;
}

void PageTable::check() const {
    const testing::TestSuite* suite = testing::UnitTest::GetInstance()->current_test_suite();
    if (suite->test_to_run_count() < suite->total_test_count()) return;
    charts::Table table{{"method"}, {}};
    table.columns.insert(table.columns.end(), failures_.begin(), failures_.end());
    for (const std::string& method : methods_) {
        std::vector<std::string> row = {method};
        for (const std::string& failure : failures_) {
            const auto place = numbers_.find({method, failure});
            row.push_back(place == numbers_.end() ? "" : place->second);
        }
        table.rows.push_back(row);
    }
    const std::filesystem::path fresh = folders.output / (rung_ + ".csv");
    const std::filesystem::path committed = folders.tutorials / rung_ / "charts" / "stability.csv";
    charts::writeCsv(fresh, table);
    EXPECT_EQ(test::contents(fresh), test::contents(committed))
        << committed << " is not what is measured now; if that is right, copy " << fresh
        << " over it and run tutorials/pages update";
}

} // namespace gll::stability
