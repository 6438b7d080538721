// A setting that says it needs others changes nothing where one of its needs is not met, and something for
// every value that meets one: compares frames to the bit. Settings that rungs share are tried where they are
// taught, and elsewhere only in what needs settings of that rung.
// Usage: needs RUNG
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

namespace {
using namespace gll::test;

struct With { // any of these values of that setting will do
    std::string setting;
    std::vector<std::string> values;

    bool lists(const std::string& value) const {
        return std::find(values.begin(), values.end(), value) != values.end();
    }
};
using Need = std::vector<With>; // any of these

struct Setting {
    std::string name, owner, value; // by default
    std::vector<std::string> values;
    std::vector<Need> needs; // all of these
};
using Settings = std::map<std::string, Setting>;
using Values = std::map<std::string, std::string>; // off their defaults, by setting

// Of numbers both ends of the range, unless they take long or are the same.
const std::map<std::string, std::vector<std::string>> tried = {{"camera_yaw_deg", {"-90", "60"}},
                                                               {"prefilter_samples", {"16", "32"}},
                                                               {"shadow_size", {"256", "512"}},
                                                               {"ssao_samples", {"1", "16", "32"}}};

// "RUNG setting: state" of what no frame can show, and why.
const std::map<std::string, std::string> excused = {
    {"10_deferred shadow_pcf: sun=off view=shadow", "only moments are filtered in the map itself"},
    {"10_deferred specular_aa: view=reflected", "the original mirrors the same at every width"}};

// "RUNG setting": values put into its frames that alone show what the setting does.
const std::map<std::string, std::string> injections = {{"03_gaussian_bloom guard", "bright:48,36:nan"},
                                                       {"04_pyramid_bloom guard", "walls:48,36:nan"},
                                                       {"05_hdr_bloom guard", "hdr:48,36:nan"}};

// As the command line spells it: JSON has "0.0" for 0.
std::string numberText(const nlohmann::json& number) {
    std::string text = number.dump();
    if (text.ends_with(".0")) text.resize(text.size() - 2);
    return text;
}

Setting settingOf(const nlohmann::json& listed) {
    Setting setting{listed.at("name"), listed.value("owner", ""), "", {}, {}};
    const auto& by_default = listed.at("default");
    if (by_default.is_boolean()) {
        setting.value = by_default.get<bool>() ? "on" : "off";
        setting.values = {"on", "off"};
    } else if (by_default.is_string()) {
        setting.value = by_default;
        setting.values = listed.at("choices");
    } else {
        setting.value = numberText(by_default);
        const auto found = tried.find(setting.name);
        setting.values = found != tried.end()
                             ? found->second
                             : std::vector{numberText(listed.at("min")), numberText(listed.at("max"))};
    }
    for (const auto& listed_need : listed.value("needs", nlohmann::json::array())) {
        Need& need = setting.needs.emplace_back();
        for (const auto& with : listed_need)
            need.push_back({with.at("setting"), with.at("values")});
    }
    return setting;
}

// A rung's settings, and frames of them, drawn all at once and each only once.
class Frames {
  public:
    explicit Frames(std::filesystem::path rung) : rung_(std::move(rung)) {
        const auto listed = nlohmann::json::parse(runToSuccess({rung_, {"--settings", "--json"}}).out);
        for (const auto& one : listed.at("settings"))
            settings_.emplace(one.at("name"), settingOf(one));
    }

    const Settings& settings() const { return settings_; }
    std::string rung() const { return rung_.filename().string(); }

    // The number of the frame with these values.
    std::size_t of(Values values, const std::string& inject) {
        std::erase_if(values, [&](const auto& one) { return one.second == settings_.at(one.first).value; });
        const auto [found, is_new] = numbers_.try_emplace({values, inject}, files_.size());
        if (is_new) {
            files_.push_back(folder_ / (std::to_string(files_.size()) + ".png"));
            nlohmann::json line{{"frame", 60}, {"size", "96x72"}, {"out", files_.back().string()}};
            line["set"] = values;
            if (!inject.empty()) line["inject"] = inject;
            batch_ += line.dump() + "\n";
        }
        return found->second;
    }

    // Draws what was asked for since the last time.
    void draw() {
        if (contents_.size() == files_.size()) return;
        runToSuccess({rung_, {"--headless", "--batch", folder_.write("batch.jsonl", batch_).string()}});
        batch_.clear();
        while (contents_.size() < files_.size()) {
            const std::filesystem::path& file = files_[contents_.size()];
            std::ifstream stream(file, std::ios::binary);
            contents_.emplace_back(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
            if (contents_.back().empty()) throw std::runtime_error(file.string() + ": was not written");
        }
    }

    // False where one of them is not drawn yet.
    bool areDifferent(std::size_t one, std::size_t other) const {
        return std::max(one, other) < contents_.size() && contents_[one] != contents_[other];
    }
    std::size_t count() const { return files_.size(); }

  private:
    std::filesystem::path rung_;
    TemporaryFolder folder_;
    Settings settings_;
    std::map<std::pair<Values, std::string>, std::size_t> numbers_;
    std::vector<std::filesystem::path> files_;
    std::vector<std::string> contents_; // of the files: the same pixels are written as the same bytes
    std::string batch_;
};

// What a setting is said to do in a state: change the frame by one of its values, or by none.
struct Claim {
    std::string setting;
    Values state;
    bool has_effect = false;
    std::vector<std::string> others = {}; // values of the setting
};

class Claims {
  public:
    explicit Claims(Frames& frames) : frames_(frames), settings_(frames.settings()) {}

    std::vector<Claim> all() {
        for (const auto& [name, setting] : settings_)
            for (std::size_t i = 0; i < setting.needs.size(); ++i)
                if (!isTriedElsewhere(setting, setting.needs[i])) add(setting, i);
        return std::move(claims_);
    }

  private:
    bool isTriedElsewhere(const Setting& setting, const Need& need) const {
        return !setting.owner.empty() && setting.owner != frames_.rung() &&
               std::all_of(need.begin(), need.end(), [&](const With& with) {
                   return settings_.at(with.setting).owner == setting.owner;
               });
    }

    // As by default, and where that does not meet the needs of a setting, the first that does.
    void meet(const std::string& name, Values& values) const {
        for (const Need& need : settings_.at(name).needs)
            if (!isMet(need, values)) set(need.front().setting, need.front().values.front(), values);
    }

    void set(const std::string& name, const std::string& value, Values& values) const {
        values[name] = value;
        meet(name, values);
    }

    std::string valueOf(const std::string& name, const Values& values) const {
        const auto found = values.find(name);
        return found != values.end() ? found->second : settings_.at(name).value;
    }

    bool isMet(const Need& need, const Values& values) const {
        return std::any_of(need.begin(), need.end(), [&](const With& with) {
            const std::vector<Need>& further = settings_.at(with.setting).needs;
            return with.lists(valueOf(with.setting, values)) &&
                   std::all_of(further.begin(), further.end(),
                               [&](const Need& one) { return isMet(one, values); });
        });
    }

    // What is not among the values of a need; the default where that is so.
    std::vector<std::string> unlisted(const With& with) const {
        const Setting& setting = settings_.at(with.setting);
        std::vector<std::string> values;
        for (const std::string& value : setting.values)
            if (!with.lists(value)) values.push_back(value);
        const auto by_default = std::find(values.begin(), values.end(), setting.value);
        if (by_default != values.end()) std::rotate(values.begin(), by_default, by_default + 1);
        if (values.empty()) throw std::runtime_error(with.setting + " meets a need with whatever value");
        return values;
    }

    // The setting's other needs are met, and of this one all alternatives but `spared` are not.
    Values around(const Setting& setting, std::size_t need, const With* spared) const {
        Values values;
        for (std::size_t i = 0; i < setting.needs.size(); ++i)
            if (i != need && !isMet(setting.needs[i], values))
                set(setting.needs[i].front().setting, setting.needs[i].front().values.front(), values);
        for (const With& with : setting.needs[need])
            if (&with != spared) values[with.setting] = unlisted(with).front();
        return values;
    }

    void add(const Setting& setting, std::size_t i) {
        for (const With& with : setting.needs[i]) {
            const Values without = around(setting, i, &with);
            for (const std::string& value : unlisted(with)) {
                Values values = without;
                values[with.setting] = value;
                claim(setting, values, false);
            }
            for (const std::string& value : with.values) {
                Values values = without;
                set(with.setting, value, values);
                claim(setting, values, true);
            }
        }
    }

    void claim(const Setting& setting, const Values& state, bool has_effect) {
        Claim& claim = claims_.emplace_back(Claim{setting.name, state, has_effect});
        for (const std::string& value : setting.values)
            if (value != valueOf(setting.name, state)) claim.others.push_back(value);
        // one of them from claim to claim, so that all have their turn
        std::rotate(claim.others.begin(),
                    claim.others.begin() + static_cast<std::ptrdiff_t>(claims_.size() % claim.others.size()),
                    claim.others.end());
    }

    Frames& frames_;
    const Settings& settings_;
    std::vector<Claim> claims_;
};

std::string textOf(const Values& values) {
    std::string text;
    for (const auto& [name, value] : values)
        text += (text.empty() ? "" : " ") + name + "=" + value;
    return text;
}

// Whether a frame with one of the first `count` values of a claim differs from that of its state. Asks for
// those that are not drawn yet.
bool differs(Frames& frames, const Claim& claim, std::size_t count) {
    const auto injection = injections.find(frames.rung() + " " + claim.setting);
    const std::string inject = injection != injections.end() ? injection->second : "";
    const std::size_t state = frames.of(claim.state, inject);
    bool result = false;
    for (std::size_t i = 0; i < std::min(count, claim.others.size()); ++i) {
        Values values = claim.state;
        values[claim.setting] = claim.others[i];
        result = frames.areDifferent(state, frames.of(values, inject)) || result;
    }
    return result;
}

// Draws what tells: one value for each claim, and all where that changes nothing but should.
std::set<const Claim*> thoseWithEffect(Frames& frames, const std::vector<Claim>& claims) {
    std::set<const Claim*> found;
    for (const std::size_t tried_values : {std::size_t(1), std::size_t(-1)}) {
        const auto isOpen = [&](const Claim& claim) {
            return !found.contains(&claim) && (tried_values == 1 || claim.has_effect);
        };
        for (const Claim& claim : claims)
            if (isOpen(claim)) differs(frames, claim, tried_values);
        frames.draw();
        for (const Claim& claim : claims)
            if (isOpen(claim) && differs(frames, claim, tried_values)) found.insert(&claim);
    }
    return found;
}

int check(const std::filesystem::path& rung) {
    Frames frames(rung);
    const std::vector<Claim> claims = Claims(frames).all();
    const std::set<const Claim*> with_effect = thoseWithEffect(frames, claims);
    int wrong = 0;
    std::set<std::string> excuses;
    for (const Claim& claim : claims) {
        const bool changes = with_effect.contains(&claim);
        if (changes == claim.has_effect) continue;
        const std::string what = rung.filename().string() + " " + claim.setting + ": " + textOf(claim.state);
        if (claim.has_effect && excused.contains(what)) {
            excuses.insert(what);
            continue;
        }
        std::printf("%s: %s\n", what.c_str(),
                    changes ? "changes the frame, and is said to need something else"
                            : "changes nothing, and is said to have an effect");
        ++wrong;
    }
    for (const auto& [what, reason] : excused)
        if (what.starts_with(rung.filename().string() + " ") && !excuses.contains(what)) {
            std::printf("%s: is excused here without need, as \"%s\"\n", what.c_str(), reason.c_str());
            ++wrong;
        }
    std::printf("%zu claims, %zu frames, %d wrong\n", claims.size(), frames.count(), wrong);
    return wrong == 0 ? 0 : 1;
}

} // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fprintf(stderr, "usage: needs RUNG\n");
        return 2;
    }
    try {
        return check(argv[1]);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "needs: error: %s\n", error.what());
        return 1;
    }
}
