// What a page says first, and what settings are called for people.
#include "window/help.hpp"
#include "window/panel.hpp"

#include <gtest/gtest.h>

namespace gll::test {
namespace {

TEST(HelpTest, aPageIsReadUpToItsSecondSection) {
    const std::vector<Paragraph> paragraphs = firstSection("# 05_hdr_bloom\n"
                                                           "\n"
                                                           "*A swarm*\n"
                                                           "\n"
                                                           "![The swarm](images/default.png)\n"
                                                           "\n"
                                                           "You will see `hdr` and\n"
                                                           "[01_hdr](../01_hdr/README.md), too.\n"
                                                           "\n"
                                                           "```\n"
                                                           "a command\n"
                                                           "```\n"
                                                           "\n"
                                                           "## The idea\n"
                                                           "\n"
                                                           "Light spills.\n"
                                                           "| a | table |\n"
                                                           "<img src=\"x.png\">\n"
                                                           "It does.\n"
                                                           "## The frame\n"
                                                           "Not this.\n");
    const std::vector<Paragraph> expected = {{"A swarm"},
                                             {"You will see hdr and 01_hdr, too."},
                                             {"The idea", true},
                                             {"Light spills."},
                                             {"It does."}};
    EXPECT_EQ(paragraphs, expected);
}

TEST(HelpTest, aBrokenPageIsReadAsItStands) {
    EXPECT_TRUE(firstSection("").empty());
    EXPECT_EQ(firstSection("[open ![").size(), 1U);
    EXPECT_EQ(firstSection("a ](b").front().text, "a ");
}

TEST(LabelTest, namesAreSpelledOutWithTheirUnits) {
    EXPECT_EQ(labelOf("exposure_ev"), "Exposure (EV)");
    EXPECT_EQ(labelOf("camera_yaw_deg"), "Camera yaw (\u00b0)");
    EXPECT_EQ(labelOf("ssao_samples"), "SSAO samples");
    EXPECT_EQ(labelOf("bloom"), "Bloom");
    EXPECT_EQ(labelOf("s"), "S");
    EXPECT_EQ(labelOf(""), "");
}

} // namespace
} // namespace gll::test
