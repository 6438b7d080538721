// Writing the page of frames that are not as blessed.
#include "golden/report.hpp"

#include <fstream>
#include <stdexcept>

namespace gll::test {
namespace {

constexpr const char* style = R"(
body { font: 14px sans-serif; background: #1c1c1e; color: #ddd; margin: 2em; }
figure { display: inline-block; margin: 0 1em 1em 0; }
img { display: block; image-rendering: pixelated; min-width: 320px; }
.swap { position: relative; }
.swap img + img { position: absolute; top: 0; left: 0; opacity: 0; }
.swap:hover img + img { opacity: 1; }
code { color: #9cf; }
)";

std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text) {
        if (c == '<')
            result += "&lt;";
        else if (c == '&')
            result += "&amp;";
        else if (c == '"')
            result += "&quot;";
        else
            result += c;
    }
    return result;
}

std::string image(const std::string& file) { return "<img src=\"" + escaped(file) + "\" alt=\"\">"; }

std::string figure(const std::string& content, const std::string& caption) {
    return "<figure>" + content + "<figcaption>" + caption + "</figcaption></figure>\n";
}

} // namespace

void writeReport(const std::filesystem::path& page, const std::string& title,
                 const std::vector<ReportEntry>& entries) {
    std::ofstream stream(page);
    stream << "<!doctype html>\n<meta charset=\"utf-8\">\n<title>" << escaped(title) << "</title>\n<style>"
           << style << "</style>\n<h1>" << escaped(title) << "</h1>\n";
    for (const ReportEntry& entry : entries) {
        stream << "<h2>" << escaped(entry.name) << "</h2>\n<p>" << escaped(entry.verdict) << "<br><code>"
               << escaped(entry.request) << "</code></p>\n";
        if (entry.reference.empty()) {
            stream << figure(image(entry.image), "new; there is no reference");
            continue;
        }
        stream << figure("<div class=\"swap\">" + image(entry.image) + image(entry.reference) + "</div>",
                         "new; hover for the reference")
               << figure(image(entry.reference), "reference")
               << figure(image(entry.difference), "difference, 32 times as bright");
    }
    stream.close();
    if (!stream) throw std::runtime_error(page.string() + ": cannot be written");
}

} // namespace gll::test
