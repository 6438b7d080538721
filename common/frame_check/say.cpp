// Wording results for people and for machines.
#include "frame_check/say.hpp"

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <stdexcept>

namespace gll::frame_check {
namespace {
namespace fs = std::filesystem;

std::string seconds(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3f", value);
    return text;
}

// Why it is no pass, or what is tolerated, on one line.
std::string reason(const CaseResult& result) {
    if (result.outcome == Outcome::incomparable) return result.why;
    if (!result.measurement) return "as blessed";
    std::string text = result.measurement->line();
    if (const std::string first = result.firstDifferent(); !first.empty())
        text += "  first target that differs: " + first;
    return text;
}

// The values of GitHub's commands: percent signs and line ends, in properties colons and commas too.
std::string commandText(const std::string& text, bool is_property) {
    std::string result;
    for (const char c : text) {
        const bool is_special = c == '%' || c == '\r' || c == '\n' || (is_property && (c == ':' || c == ','));
        char code[4];
        std::snprintf(code, sizeof code, "%%%02X", static_cast<unsigned>(static_cast<unsigned char>(c)));
        result += is_special ? std::string(code) : std::string(1, c);
    }
    return result;
}

// From where the repository is checked out, as the annotations want it.
std::string fromWorkspace(const fs::path& file) {
    const char* workspace = std::getenv("GITHUB_WORKSPACE");
    const fs::path base =
        workspace != nullptr && *workspace != '\0' ? fs::path(workspace) : fs::current_path();
    const fs::path relative = file.lexically_relative(base);
    return relative.empty() || *relative.begin() == ".." ? file.string() : relative.string();
}

void write(const fs::path& file, const std::string& text) {
    if (file.has_parent_path()) fs::create_directories(file.parent_path());
    std::ofstream stream(file, std::ios::binary);
    stream << text;
    stream.close();
    if (!stream) throw std::runtime_error(file.string() + ": cannot be written");
}

std::string junitCase(const CaseResult& result) {
    std::string text = "    <testcase classname=\"" + escaped(result.suite) + "\" name=\"" +
                       escaped(result.name) + "\" time=\"" + seconds(result.seconds) + "\"";
    if (result.outcome == Outcome::same) return text + "/>\n";
    text += ">\n";
    const std::string details = "settings: " + result.settings + "\nrule: " + result.rule.text() +
                                "\nto draw it: " + result.render_line +
                                "\nto accept it: " + result.bless_line + "\n" +
                                (result.measurement ? result.measurement->comparison.map() : "");
    if (result.outcome == Outcome::tolerated)
        text += "      <system-out>" + escaped("warning, tolerated: " + reason(result)) + "</system-out>\n";
    else {
        const char* tag = result.outcome == Outcome::different ? "failure" : "error";
        text += std::string("      <") + tag + " message=\"" + escaped(reason(result)) + "\">" +
                escaped(details) + "</" + tag + ">\n";
    }
    return text + "    </testcase>\n";
}

} // namespace

std::string Counts::text() const {
    return std::to_string(same + tolerated + different + incomparable) + " frames: " + std::to_string(same) +
           " same, " + std::to_string(tolerated) + " tolerated, " + std::to_string(different) +
           " different, " + std::to_string(incomparable) + " not compared";
}

Counts countsOf(const std::vector<SuiteResult>& suites) {
    Counts counts;
    for (const SuiteResult& suite : suites) {
        for (const CaseResult& result : suite.cases)
            ++(result.outcome == Outcome::same        ? counts.same
               : result.outcome == Outcome::tolerated ? counts.tolerated
               : result.outcome == Outcome::different ? counts.different
                                                      : counts.incomparable);
        counts.incomparable += suite.problems.size();
    }
    return counts;
}

std::string word(Outcome outcome) {
    constexpr const char* words[] = {"same", "tolerated", "DIFFERENT", "NOT COMPARED"};
    return words[static_cast<std::size_t>(outcome)];
}

std::string line(const CaseResult& result) {
    char start[160];
    std::snprintf(start, sizeof start, "%-12s %-40s", word(result.outcome).c_str(),
                  result.fullName().c_str());
    std::string text = start;
    if (result.fullName().size() > 100) text = word(result.outcome) + " " + result.fullName();
    text += " " + reason(result) + "\n";
    return text + (result.outcome == Outcome::different ? result.measurement->comparison.map() : "");
}

std::string annotations(const std::vector<SuiteResult>& suites) {
    std::string text;
    for (const SuiteResult& suite : suites) {
        for (const CaseResult& result : suite.cases) {
            if (result.outcome == Outcome::same) continue;
            text += result.outcome == Outcome::tolerated ? "::warning " : "::error ";
            if (!result.json_file.empty())
                text += "file=" + commandText(fromWorkspace(result.json_file), true) + ",";
            text += "title=" + commandText("frame " + result.fullName() + " " + word(result.outcome), true) +
                    "::" + commandText(reason(result), false) + "\n";
        }
        for (const std::string& problem : suite.problems)
            text += "::error title=" + commandText("frames of " + suite.name, true) +
                    "::" + commandText(problem, false) + "\n";
    }
    return text;
}

void writeJunit(const fs::path& file, const std::vector<SuiteResult>& suites) {
    std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"frame_check\">\n";
    for (const SuiteResult& suite : suites) {
        const Counts counts = countsOf({suite});
        double time = 0;
        std::string cases;
        for (const CaseResult& result : suite.cases) {
            time += result.seconds;
            cases += junitCase(result);
        }
        for (const std::string& problem : suite.problems)
            cases += "    <testcase classname=\"" + escaped(suite.name) + "\" name=\"" +
                     escaped(problem.substr(0, problem.find(':'))) +
                     "\" time=\"0\">\n      <error message=\"" + escaped(problem) + "\"/>\n    </testcase>\n";
        text += "  <testsuite name=\"" + escaped(suite.name.empty() ? "frames" : suite.name) + "\" tests=\"" +
                std::to_string(suite.cases.size() + suite.problems.size()) + "\" failures=\"" +
                std::to_string(counts.different) + "\" errors=\"" + std::to_string(counts.incomparable) +
                "\" time=\"" + seconds(time) + "\">\n" + cases + "  </testsuite>\n";
    }
    write(file, text + "</testsuites>\n");
}

void writeWarnings(const fs::path& file, const std::vector<SuiteResult>& suites) {
    std::string text;
    for (const SuiteResult& suite : suites)
        for (const CaseResult& result : suite.cases)
            if (result.outcome == Outcome::tolerated)
                text += result.fullName() + ": warning, tolerated: " + reason(result) + ", hash " +
                        result.hash + "\n";
    std::error_code ignored;
    fs::remove(file, ignored);
    if (!text.empty()) write(file, text);
}

std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text) {
        if (c == '<')
            result += "&lt;";
        else if (c == '>')
            result += "&gt;";
        else if (c == '&')
            result += "&amp;";
        else if (c == '"')
            result += "&quot;";
        else if (static_cast<unsigned char>(c) >= 0x20 || c == '\n' || c == '\t')
            result += c;
    }
    return result;
}

} // namespace gll::frame_check
