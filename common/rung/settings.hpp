// A rung's settings. Each is declared once: its name, range or choices, default and a line of help. That one
// declaration serves the command line, the window's panel, --settings, the charts and the tests.
#pragma once

#include "gl/program.hpp" // Defines

#include <deque>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gll {

struct Setting {
    enum class Kind { number, integer, toggle, choice };
    // What others may do with it without knowing the rung: the window turns and moves the camera.
    enum class Role { none, orbit_yaw, orbit_pitch, orbit_zoom };
    // Where it stands in a list for people: what is taught, what is drawn with it, and how that is displayed.
    enum class Group { method, look, camera, tone };
    // Other settings, and values of theirs with which this one has an effect: any of them will do.
    struct With {
        std::string setting;
        std::vector<std::string> values;
    };
    using Need = std::vector<With>;

    std::string name;
    std::string help; // one line, with the unit
    Kind kind = Kind::number;
    double default_value = 0; // a toggle's is 0 or 1, a choice's the index among choices
    double min = 0;
    double max = 0;
    std::vector<std::string> choices = {};
    double value = 0;
    std::string owner = {}; // the rung that teaches it, where rungs share it; empty: this one
    Role role = Role::none;
    Group group = Group::method;
    std::vector<Need> needs = {}; // all of them have to be met, or it changes nothing

    // As the command line spells it: "0.6", "5", "on", "aces_narkowicz".
    std::string text() const;
};

inline constexpr const char* group_names[] = {"method", "look", "camera", "tone"}; // of Setting::Group

// Handles a rung keeps for reading its settings; valid as long as the Settings they came from.
class Number {
  public:
    explicit Number(const Setting& setting) : setting_(&setting) {}
    operator float() const { return static_cast<float>(setting_->value); }

  private:
    const Setting* setting_;
};

class Integer {
  public:
    explicit Integer(const Setting& setting) : setting_(&setting) {}
    operator int() const { return static_cast<int>(setting_->value); }

  private:
    const Setting* setting_;
};

class Toggle {
  public:
    explicit Toggle(const Setting& setting) : setting_(&setting) {}
    operator bool() const { return setting_->value != 0; }

  private:
    const Setting* setting_;
};

class Choice {
  public:
    explicit Choice(const Setting& setting) : setting_(&setting) {}
    // Throws std::logic_error for a text that is none of the choices: a method misspelt in the code would
    // never be drawn.
    bool operator==(std::string_view choice) const;
    const std::string& name() const { return setting_->choices[static_cast<std::size_t>(setting_->value)]; }

    // For shader variants: "NAME_CHOICE n" for every choice, in capitals, and "NAME n" for the present one,
    // so that the shader reads #if DOWN_FILTER == DOWN_FILTER_BOX and the list stands in one place.
    Defines defines() const;

  private:
    const Setting* setting_;
};

class Settings {
  public:
    Settings() = default;
    Settings(const Settings&) = delete; // handles point into it
    Settings& operator=(const Settings&) = delete;

    // Declarations. Numbers are finite; ranges include both ends.
    Number number(std::string name, double default_value, double min, double max, std::string help);
    Integer integer(std::string name, int default_value, int min, int max, std::string help);
    Toggle toggle(std::string name, bool default_value, std::string help);
    Choice choice(std::string name, std::string_view default_value, std::vector<std::string> choices,
                  std::string help);

    // Settings that rungs share, and the rung that teaches them: its goldens show all their choices, those of
    // the other rungs one each. Throws UsageError where one is not declared.
    void shared(std::string_view owner, std::initializer_list<std::string_view> names);

    // Throw UsageError where one is not declared.
    void role(Setting::Role role, std::initializer_list<std::string_view> names);
    void group(Setting::Group group, std::initializer_list<std::string_view> names);

    // These settings change no picture unless another one has one of the values that the need names. Several
    // needs of one setting have to be met together. Throws UsageError where a setting or a value is not
    // declared.
    void needs(std::initializer_list<std::string_view> names, const Setting::Need& need);

    // "only with tone_map = reinhard_extended": the first need that the present values do not meet, or that
    // is met by settings alone whose own needs are not. Empty where it has an effect.
    std::string whyIdle(const Setting& setting) const;

    // A named set of values over the defaults. "original", the defaults themselves, always exists; it was
    // once called "seed", which applyPreset() still takes.
    struct Preset {
        std::string name;
        std::string help;
        std::vector<std::pair<std::string, std::string>> values;
    };
    void preset(Preset preset);

    // A setting that trades accuracy for cost: its values from the most accurate on. Without values, an
    // integer's: from what it is set to down to its least.
    struct Dial {
        std::string setting;
        std::vector<std::string> values = {};
    };
    void dial(Dial dial);

    // Throws UsageError naming the setting, the value, and what is allowed.
    void set(std::string_view name, std::string_view value);
    void set(std::string_view key_equals_value);
    void applyPreset(std::string_view name); // resets everything else to its default
    void reset();

    const std::deque<Setting>& all() const { return settings_; }
    std::deque<Setting>& all() { return settings_; }
    const std::vector<Preset>& presets() const { return presets_; }
    const std::vector<Dial>& dials() const { return dials_; }
    Setting& at(std::string_view name); // throws UsageError where there is none
    const Setting& at(std::string_view name) const;

    // KEY=VALUE for every setting that differs from its default; the same as one line, each after "--set".
    std::vector<std::string> changed() const;
    std::string commandLine() const;

  private:
    Setting& add(Setting setting);

    std::deque<Setting> settings_; // a deque, so that handles stay valid while more are declared
    std::vector<Preset> presets_{{"original", "the original tutorial's numbers", {}}};
    std::vector<Dial> dials_;
};

} // namespace gll
