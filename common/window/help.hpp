// What F1 shows: the keys, and what the rung is about, from its page.
#pragma once

#include "rung/resources.hpp"
#include "window/layout.hpp"

#include <string>
#include <vector>

namespace gll {

// The beginning of a page as plain text: its summary, what one will see, and its first section. Markdown's
// pictures, tables, code and links' targets are left out.
struct Paragraph {
    std::string text;
    bool is_heading = false;

    bool operator==(const Paragraph&) const = default;
};
std::vector<Paragraph> firstSection(const std::string& markdown);

class Help {
  public:
    // Reads the rung's page. Where it is not there, the text says so.
    Help(const Resources& resources, const std::string& rung);

    void draw(const Rectangle& picture, float pixels_per_unit);

    bool visible = false;

  private:
    std::string title_;
    std::vector<Paragraph> about_;
};

} // namespace gll
