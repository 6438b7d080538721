// What files make a rung warn of: said once, and no more of it than one reads.
#include "rung/warnings.hpp"

#include <gtest/gtest.h>

using namespace gll;

TEST(Warnings, AreTakenInTheirOrderAndOnlyOnce) {
    Warnings warnings;
    EXPECT_TRUE(warnings.take().empty());
    warnings.add({"a.obj:1: one", "a.obj:2: two"});
    warnings.add({"b.png: three"});
    EXPECT_EQ(warnings.take(), (std::vector<std::string>{"a.obj:1: one", "a.obj:2: two", "b.png: three"}));
    EXPECT_TRUE(warnings.take().empty());
    warnings.add({"b.png: three", "c.png: four"});
    EXPECT_EQ(warnings.take(), std::vector<std::string>{"c.png: four"}) << "a file may be read twice";
}

TEST(Warnings, BeyondTenAreCounted) {
    Warnings warnings;
    std::vector<std::string> lines;
    for (int i = 0; i < 10; ++i)
        lines.push_back("a.obj:" + std::to_string(i) + ": x");
    warnings.add(lines);
    EXPECT_EQ(warnings.take(), lines);
    for (std::string& line : lines)
        line[0] = 'b';
    lines.insert(lines.end(), {"c: y", "d: z"});
    warnings.add(lines);
    const std::vector<std::string> taken = warnings.take();
    ASSERT_EQ(taken.size(), 11u);
    EXPECT_EQ(taken[9], lines[9]);
    EXPECT_EQ(taken[10], "... and 2 more");
    warnings.add({"d: z"});
    EXPECT_TRUE(warnings.take().empty()) << "what was counted was said";
}

TEST(Warnings, AreOneLineEachWhateverAFileCallsItsThings) {
    Warnings warnings;
    warnings.add({"a.obj: material 'x\ny\x1b[2J'"});
    EXPECT_EQ(warnings.take(), std::vector<std::string>{"a.obj: material 'x y [2J'"});
}
