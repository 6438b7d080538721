// Settings: what each kind accepts, how they are spelt, presets, and the command line they make.
#include "rung/settings.hpp"
#include "rung/usage_error.hpp"
#include "support/messages.hpp"
#include "support/temporary_folder.hpp"

#include <gtest/gtest.h>

namespace gll::test {
namespace {

class SettingsTest : public testing::Test {
  protected:
    std::string errorOf(std::string_view name, std::string_view value) {
        return messageOf<UsageError>([&] { all.set(name, value); });
    }

    Settings all;
    Number knee = all.number("knee", 0.6, 0, 100, "help");
    Integer levels = all.integer("levels", 5, 1, 8, "help");
    Toggle bloom = all.toggle("bloom", true, "help");
    Choice filter = all.choice("down_filter", "5tap", {"13tap", "5tap", "tent-2"}, "help");
};

TEST_F(SettingsTest, everySettingBeginsAtItsDefault) {
    EXPECT_FLOAT_EQ(knee, 0.6F);
    EXPECT_EQ(int(levels), 5);
    EXPECT_TRUE(bloom);
    EXPECT_TRUE(filter == "5tap");
    EXPECT_EQ(all.commandLine(), "");
}

TEST_F(SettingsTest, rangesIncludeBothEndsAndNothingBeyond) {
    EXPECT_EQ(errorOf("knee", "0"), "");
    EXPECT_EQ(errorOf("knee", "100"), "");
    EXPECT_EQ(errorOf("knee", "-0.0001"), "setting knee: \"-0.0001\" is not a number from 0 to 100");
    EXPECT_NE(errorOf("knee", "100.00001"), "");
    EXPECT_EQ(errorOf("levels", "1"), "");
    EXPECT_EQ(errorOf("levels", "8"), "");
    EXPECT_EQ(errorOf("levels", "9"), "setting levels: \"9\" is not a whole number from 1 to 8");
    EXPECT_NE(errorOf("levels", "0"), "");
}

TEST_F(SettingsTest, whatIsNoFiniteNumberIsRefusedAndChangesNothing) {
    for (const char* text : {"nan", "NaN", "-nan", "inf", "-inf", "infinity", "1e999", "", " 1", "1 ", "1,5",
                             "0x10", "1.5.2", "one", "--1", "+1"}) {
        EXPECT_NE(errorOf("knee", text), "") << text;
        EXPECT_NE(errorOf("levels", text), "") << text;
    }
    EXPECT_FLOAT_EQ(knee, 0.6F);
    EXPECT_EQ(int(levels), 5);
}

TEST_F(SettingsTest, aWholeNumberTakesNoFraction) {
    EXPECT_NE(errorOf("levels", "2.5"), "");
    EXPECT_EQ(errorOf("levels", "2.0"), "");
    EXPECT_EQ(int(levels), 2);
}

TEST_F(SettingsTest, aSettingSaysWithWhichOthersItHasAnEffect) {
    const Setting& knee_setting = all.at("knee");
    all.needs({"knee", "levels"}, {{"bloom", {"on"}}});
    all.needs({"knee"}, {{"down_filter", {"13tap", "tent-2"}}, {"levels", {"1"}}});
    EXPECT_EQ(all.whyIdle(knee_setting), "only with down_filter = 13tap or tent-2, or levels = 1");
    all.set("levels", "1");
    EXPECT_EQ(all.whyIdle(knee_setting), "");
    all.set("levels", "5");
    all.set("down_filter", "tent-2");
    EXPECT_EQ(all.whyIdle(knee_setting), "");
    all.set("bloom", "off");
    EXPECT_EQ(all.whyIdle(knee_setting), "only with bloom = on");
    EXPECT_EQ(all.whyIdle(all.at("bloom")), "");
}

TEST_F(SettingsTest, aNeedThatOnlyAnIdleSettingMeetsIsNotMet) {
    all.needs({"levels"}, {{"bloom", {"on"}}});
    all.needs({"knee"}, {{"levels", {"5"}}});
    all.set("bloom", "off");
    EXPECT_EQ(all.whyIdle(all.at("knee")), "only with bloom = on");
}

TEST_F(SettingsTest, aNeedOfWhatIsNotDeclaredFailsAtOnce) {
    EXPECT_NE(messageOf<UsageError>([&] { all.needs({"knee"}, {{"blom", {"on"}}}); }), "");
    EXPECT_NE(messageOf<UsageError>([&] { all.needs({"knee"}, {{"bloom", {"maybe"}}}); }), "");
    EXPECT_NE(messageOf<UsageError>([&] { all.needs({"kne"}, {{"bloom", {"on"}}}); }), "");
    EXPECT_TRUE(bloom);
}

TEST_F(SettingsTest, togglesTakeTheUsualWordsAndNoOther) {
    for (const char* text : {"on", "true", "yes", "1"}) {
        all.set("bloom", "off");
        EXPECT_EQ(errorOf("bloom", text), "");
        EXPECT_TRUE(bloom) << text;
    }
    for (const char* text : {"off", "false", "no", "0"}) {
        all.set("bloom", "on");
        EXPECT_EQ(errorOf("bloom", text), "");
        EXPECT_FALSE(bloom) << text;
    }
    EXPECT_EQ(errorOf("bloom", "ON"), "setting bloom: \"ON\" is neither on nor off");
}

TEST_F(SettingsTest, aChoiceNamesWhatThereIs) {
    EXPECT_EQ(errorOf("down_filter", "tent-2"), "");
    EXPECT_TRUE(filter == "tent-2");
    EXPECT_EQ(errorOf("down_filter", "6tap"),
              "setting down_filter: \"6tap\" is not one of 13tap, 5tap, tent-2; did you mean 5tap?");
    EXPECT_NE(errorOf("down_filter", "0"), "");
    EXPECT_TRUE(filter == "tent-2");
}

TEST_F(SettingsTest, comparingAChoiceWithATextThatIsNoneOfThemIsAnErrorInTheProgram) {
    EXPECT_FALSE(filter == "tent-2");
    EXPECT_EQ(messageOf<std::logic_error>([&] { (void)(filter == "5tapp"); }),
              "setting down_filter is compared with \"5tapp\", which is not one of 13tap, 5tap, tent-2; "
              "did you mean 5tap?");
    EXPECT_THROW((void)(filter != "tent"), std::logic_error);
}

TEST_F(SettingsTest, choicesBecomeDefinitionsForTheShader) {
    const Defines defines = filter.defines();
    ASSERT_EQ(defines.size(), 4U);
    EXPECT_EQ(defines[0].name, "DOWN_FILTER_13TAP");
    EXPECT_EQ(defines[2].name, "DOWN_FILTER_TENT_2");
    EXPECT_EQ(defines[3].name, "DOWN_FILTER");
    EXPECT_EQ(defines[3].value, defines[1].value);
    EXPECT_NE(defines[0].value, defines[1].value);
}

TEST_F(SettingsTest, anUnknownSettingIsNamed) {
    EXPECT_EQ(errorOf("kneee", "1"), "unknown setting \"kneee\"; --settings lists them; did you mean knee?");
    EXPECT_EQ(errorOf("colour", "1"), "unknown setting \"colour\"; --settings lists them");
    EXPECT_EQ(messageOf<UsageError>([&] { all.set("knee"); }), "--set knee: write KEY=VALUE");
    EXPECT_NE(messageOf<UsageError>([&] { all.set("=1"); }), "");
    EXPECT_NE(messageOf<UsageError>([&] { all.set("knee=1=2"); }), "");
}

TEST_F(SettingsTest, theCommandLineBringsTheSameSettingsBack) {
    all.set("knee=0.1");
    all.set("levels=3");
    all.set("bloom=off");
    all.set("down_filter=13tap");
    const std::string line = all.commandLine();
    EXPECT_EQ(line, "--set knee=0.1 --set levels=3 --set bloom=off --set down_filter=13tap");
    // Numbers that no short decimal equals come back bit for bit too.
    for (const char* text : {"0.30000000000000004", "1e-300", "99.99999999999999", "0.1"}) {
        all.set("knee", text);
        const double value = all.all()[0].value;
        const std::string spelt = all.all()[0].text();
        all.reset();
        all.set("knee", spelt);
        EXPECT_EQ(all.all()[0].value, value) << spelt;
    }
    all.reset();
    EXPECT_EQ(all.commandLine(), "");
}

TEST_F(SettingsTest, aMillionIsWrittenInDigits) {
    all.integer("instances", 1'000'000, 1, 1'000'000, "help");
    EXPECT_EQ(all.all().back().text(), "1000000");
    EXPECT_CONTAINS(messageOf<UsageError>([&] { all.set("instances=0"); }), "from 1 to 1000000");
}

TEST_F(SettingsTest, aPresetResetsWhatItDoesNotName) {
    all.preset({"soft", "help", {{"knee", "2"}, {"bloom", "off"}}});
    EXPECT_FLOAT_EQ(knee, 0.6F) << "declaring it must not apply it";
    all.set("levels=2");
    all.applyPreset("soft");
    EXPECT_FLOAT_EQ(knee, 2);
    EXPECT_FALSE(bloom);
    EXPECT_EQ(int(levels), 5);
    all.applyPreset("original");
    EXPECT_EQ(all.commandLine(), "");
}

TEST_F(SettingsTest, theOriginalIsStillFoundUnderItsFormerName) {
    all.set("levels=2");
    all.applyPreset("seed");
    EXPECT_EQ(all.commandLine(), "");
}

TEST_F(SettingsTest, aPresetThatDoesNotFitIsAnErrorWhenDeclared) {
    EXPECT_THROW(all.preset({"bad", "help", {{"levels", "9"}}}), UsageError);
    EXPECT_THROW(all.preset({"worse", "help", {{"no_such", "1"}}}), UsageError);
}

TEST_F(SettingsTest, anUnknownPresetNamesWhatThereIs) {
    all.preset({"soft", "help", {}});
    all.set("levels=2");
    EXPECT_EQ(messageOf<UsageError>([&] { all.applyPreset("orignal"); }),
              "unknown preset \"orignal\"; there is original, soft; did you mean original?");
    EXPECT_EQ(int(levels), 2);
}

TEST_F(SettingsTest, handlesStayValidWhileManyMoreAreDeclared) {
    for (int i = 0; i < 1000; ++i)
        all.number(std::to_string(i), i, 0, 1000, "help");
    all.set("knee=3");
    EXPECT_FLOAT_EQ(knee, 3);
}

TEST(Settings, aDialWithAValueThatDoesNotFitIsRefusedAtOnce) {
    Settings settings;
    settings.integer("levels", 5, 1, 8, "help");
    const Choice filter = settings.choice("filter", "box", {"tent", "box"}, "help");
    settings.dial({"levels"});
    settings.dial({"filter", {"tent", "box"}});
    EXPECT_EQ(settings.dials().size(), 2U);
    EXPECT_TRUE(filter == "box"); // declaring tries values, and puts the default back
    EXPECT_THROW(settings.dial({"filter", {"cone"}}), UsageError);
    EXPECT_THROW(settings.dial({"filter"}), UsageError);
    EXPECT_THROW(settings.dial({"colour"}), UsageError);
}

TEST(Settings, ofSeveralRungsNameTheOneThatOwnsThem) {
    Settings settings;
    settings.number("mine", 0, 0, 1, "help");
    settings.number("shared", 0, 0, 1, "help");
    settings.shared("01_test", {"shared"});
    EXPECT_EQ(settings.at("mine").owner, "");
    EXPECT_EQ(settings.at("shared").owner, "01_test");
    EXPECT_THROW(settings.shared("01_test", {"misspelt"}), UsageError);
}

TEST(Settings, sayWhatOthersMayDoWithThem) {
    Settings settings;
    settings.number("yaw", 0.5, 0, 1, "help");
    EXPECT_EQ(settings.at("yaw").role, Setting::Role::none);
    settings.role(Setting::Role::orbit_yaw, {"yaw"});
    EXPECT_EQ(settings.at("yaw").role, Setting::Role::orbit_yaw);
    EXPECT_THROW(settings.role(Setting::Role::orbit_yaw, {"misspelt"}), UsageError);
}

} // namespace
} // namespace gll::test
