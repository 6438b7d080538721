// Charts as SVG by gnuplot.
#include "charts/chart.hpp"

#include "charts/chart_json.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <sstream>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace gll::charts {
namespace {

std::string inQuotes(const std::string& text) { return "\"" + text + "\""; } // texts are the program's own

std::string exact(double value) {
    char buffer[40];
    std::snprintf(buffer, sizeof buffer, "%.6g", value);
    return buffer;
}

// The picture, in pixels from its top left: small, so that its texts stay readable where it is shown at half
// the width of a page.
constexpr double width = 760;
constexpr double height = 520;
constexpr double plot_left = 96;
constexpr double plot_top = 66;
constexpr double plot_bottom = 434;
constexpr double plot_right = 745;
constexpr double plot_right_beside_key = 570;
constexpr int name_px = 14;
constexpr int dial_px = 11;

struct Theme {
    const char* file_ending;
    const char* background;
    const char* text;
    const char* faint_text;
    const char* grid;
    std::array<const char*, 7> methods;
};

// Colours that colour-blind readers tell apart (Okabe, Ito, "Color Universal Design", 2008), without yellow,
// which white hides; on the dark page white for black, and the two darkest lighter.
constexpr Theme themes[] = {{"",
                             "#ffffff",
                             "#1f2328",
                             "#59636e",
                             "#e4e7ea",
                             {"#d55e00", "#0072b2", "#009e73", "#cc79a7", "#000000", "#e69f00", "#56b4e9"}},
                            {"_dark",
                             "#0d1117",
                             "#e6edf3",
                             "#9198a1",
                             "#262c34",
                             {"#f07f2e", "#4a9fe0", "#1fbf92", "#dd92bb", "#ffffff", "#e69f00", "#8fd0f5"}}};

// A colour between two, 0: the first, 1: the second; each as "#rrggbb".
std::string mixed(const std::string& from, const std::string& to, double share) {
    const auto channel = [](const std::string& color, std::size_t i) {
        return std::stoi(color.substr(1 + 2 * i, 2), nullptr, 16);
    };
    char buffer[8];
    std::string text = "#";
    for (std::size_t i = 0; i < 3; ++i) {
        const double value = (1 - share) * channel(from, i) + share * channel(to, i);
        std::snprintf(buffer, sizeof buffer, "%02x", static_cast<unsigned>(std::lround(value)));
        text += buffer;
    }
    return text;
}

struct Box {
    double left, top, right, bottom;

    bool overlaps(const Box& other) const {
        return left < other.right && other.left < right && top < other.bottom && other.top < bottom;
    }
};

// The chart's ranges, and where a point lands in the picture.
struct Scale {
    double x_begin = 0;
    double x_end = 1;
    double y_begin = 0;
    double y_end = 1;
    bool log_x = false;
    bool log_y = false;
    double right_px = plot_right;

    double x(double cost) const {
        return plot_left + (right_px - plot_left) * part(cost, x_begin, x_end, log_x);
    }
    double y(double error) const {
        return plot_bottom - (plot_bottom - plot_top) * part(error, y_begin, y_end, log_y);
    }

  private:
    static double part(double value, double begin, double end, bool logarithmic) {
        return logarithmic ? std::log(value / begin) / std::log(end / begin)
                           : (value - begin) / (end - begin);
    }
};

Scale scaleFor(const Axes& axes, const std::vector<Point>& points) {
    double cost = 0;
    double cheapest = points.front().cost;
    double error = axes.floor;
    for (const Point& point : points) {
        cost = std::max(cost, point.cost);
        cheapest = std::min(cheapest, point.cost);
        error = std::max(error, point.error);
    }
    Scale scale;
    scale.log_x = axes.log_x;
    scale.log_y = axes.log_y;
    scale.x_end = cost > 0 ? cost * 1.08 : 1;
    if (axes.log_x) {
        scale.x_begin = cheapest / 3; // room for names
        scale.x_end = cost * 1.5;
    }
    if (axes.log_y) {
        scale.y_begin = axes.floor;
        scale.y_end = std::pow(10, std::floor(std::log10(error)) + 1);
    } else if (error > 0)
        scale.y_end = error * 1.12;
    return scale;
}

// Puts texts beside their points where they cover nothing that is there already.
class Labels {
  public:
    Labels(double right_px, const Theme& theme) : right_px_(right_px), theme_(theme) {}

    void keepFree(const Box& box) { taken_.push_back(box); }
    void keepFreeOfPoint(double x, double y) {
        points_.push_back({x - 6, y - 6, x + 6, y + 6});
        keepFree(points_.back());
    }

    // Lines of text one below the other. A text farther off has a thin line to its point, so that it seems to
    // be no other's; near: only right beside it. False where there is no room.
    bool put(const std::vector<std::string>& lines, double x, double y, int font_px, bool near,
             const std::string& color) {
        std::size_t longest = 0;
        for (const std::string& line : lines)
            longest = std::max(longest, line.size());
        const double text_width = 0.54 * font_px * double(longest);
        const double line_height = 1.15 * font_px;
        const double half_height = 0.5 * line_height * double(lines.size());
        constexpr double gap = 9;
        const auto fits = [&](double dx, double dy, bool to_the_left) {
            const Box box = boxAt(x + dx, y + dy, text_width, half_height, to_the_left);
            return box.left >= plot_left + 3 && box.right <= right_px_ + 2 && box.top >= plot_top - 8 &&
                   box.bottom <= plot_bottom - 3 &&
                   std::none_of(taken_.begin(), taken_.end(), [&](const Box& b) { return b.overlaps(box); });
        };
        constexpr double near_by[] = {0, -10, 10};
        constexpr double far_off[] = {-20, 20, -30, 30, -42,  42,  -56,  56,
                                      -72, 72, -90, 90, -110, 110, -130, 130};
        for (const double dy : near_by)
            for (const bool to_the_left : {false, true}) {
                const double dx = to_the_left ? -gap : gap;
                if (fits(dx, dy, to_the_left)) return write(lines, x, y, dx, dy, to_the_left, font_px, color);
            }
        if (near) return false;
        for (const double dy : far_off)
            for (const double away : {gap, 0.0, 2.5 * gap, 5 * gap, 8 * gap})
                for (const bool to_the_left : {false, true}) {
                    const double dx = to_the_left ? -away : away;
                    const double side = std::copysign(half_height, -dy);
                    if (!fits(dx, dy, to_the_left) || !lineFits(x, y, dx, dy + side) ||
                        seemsToBeOf(x, y, boxAt(x + dx, y + dy, text_width, half_height, to_the_left)))
                        continue;
                    script_ << "set arrow from " << screen(x, y) << " to " << screen(x + dx, y + dy + side)
                            << " nohead lw 0.8 lc rgb '" << mixed(color, theme_.background, 0.4)
                            << "' front\n";
                    for (double part = 0; part <= 1; part += 0.1)
                        keepFree(dot(x + part * dx, y + part * (dy + side)));
                    return write(lines, x, y, dx, dy, to_the_left, font_px, color);
                }
        return false;
    }

    std::string script() const { return script_.str(); }

    static std::string screen(double x, double y) {
        return "screen " + exact(x / width) + "," + exact(1 - y / height);
    }

  private:
    // Whether a text is so near to another point that it seems to belong there.
    bool seemsToBeOf(double x, double y, const Box& text) const {
        constexpr double near_px = 7;
        const Box around{text.left - near_px, text.top - near_px, text.right + near_px,
                         text.bottom + near_px};
        return std::any_of(points_.begin(), points_.end(), [&](const Box& point) {
            return around.overlaps(point) && !point.overlaps(dot(x, y));
        });
    }

    static Box dot(double x, double y) { return {x - 1.5, y - 1.5, x + 1.5, y + 1.5}; }

    // Whether a line from a point to its text crosses nothing, from where it has left the point.
    bool lineFits(double x, double y, double dx, double dy) const {
        for (double part = 10 / std::hypot(dx, dy); part < 1; part += 0.05) {
            const Box box = dot(x + part * dx, y + part * dy);
            if (std::any_of(texts_.begin(), texts_.end(), [&](const Box& b) { return b.overlaps(box); }))
                return false;
        }
        return true;
    }

    static Box boxAt(double x, double y, double text_width, double half_height, bool to_the_left) {
        const double left = to_the_left ? x - text_width : x;
        return {left, y - half_height, left + text_width, y + half_height};
    }

    bool write(const std::vector<std::string>& lines, double x, double y, double dx, double dy,
               bool to_the_left, int font_px, const std::string& color) {
        std::size_t longest = 0;
        for (const std::string& line : lines)
            longest = std::max(longest, line.size());
        const double line_height = 1.15 * font_px;
        const double half_height = 0.5 * line_height * double(lines.size());
        texts_.push_back(boxAt(x + dx, y + dy, 0.54 * font_px * double(longest), half_height, to_the_left));
        keepFree(texts_.back());
        for (std::size_t i = 0; i < lines.size(); ++i)
            script_ << "set label " << inQuotes(lines[i]) << " at "
                    << screen(x + dx, y + dy + line_height * (double(i) + 0.5) - half_height)
                    << (to_the_left ? " right" : " left") << " font '," << font_px << "' tc rgb '" << color
                    << "' noenhanced front\n";
        return true;
    }

    double right_px_;
    const Theme& theme_;
    std::vector<Box> taken_;
    std::vector<Box> points_;
    std::vector<Box> texts_; // of those, what a line must not cross either
    std::ostringstream script_;
};

} // namespace

std::vector<bool> paretoFront(const std::vector<Point>& points) {
    std::vector<bool> front;
    for (const Point& point : points)
        front.push_back(point.competes && std::none_of(points.begin(), points.end(), [&](const Point& other) {
                            return other.competes && other.cost <= point.cost && other.error <= point.error &&
                                   (other.cost < point.cost || other.error < point.error);
                        }));
    return front;
}

std::vector<bool> worstFront(const std::vector<Point>& points) {
    std::vector<Point> worst;
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto same = std::find_if(worst.begin(), worst.end(),
                                       [&](const Point& w) { return w.method == points[i].method; });
        const auto place = static_cast<std::size_t>(same - worst.begin());
        if (same == worst.end()) {
            worst.push_back(points[i]);
            places.push_back(i);
        } else if (points[i].error > same->error) {
            worst[place] = points[i];
            places[place] = i;
        }
    }
    const std::vector<bool> best = paretoFront(worst);
    std::vector<bool> front(points.size());
    for (std::size_t i = 0; i < worst.size(); ++i)
        front[places[i]] = best[i];
    return front;
}

std::vector<bool> frontOf(const Axes& axes, const std::vector<Point>& points) {
    if (!axes.x_is_cost) return std::vector<bool>(points.size());
    return axes.dial_is_given ? worstFront(points) : paretoFront(points);
}

namespace {

// A chart as a gnuplot script. Names that find no room beside their points go into a key, which makes the
// chart narrower; missing says whether there were such.
std::string chartScript(const Axes& axes, const std::vector<Point>& points, const Theme& theme, bool with_key,
                        bool& missing) {
    const std::vector<bool> front = frontOf(axes, points);
    Scale scale = scaleFor(axes, points);
    scale.right_px = with_key ? plot_right_beside_key : plot_right;
    const auto y = [&](double error) { return axes.log_y ? std::max(error, axes.floor) : error; };
    std::vector<std::string> methods;
    for (const Point& point : points)
        if (std::find(methods.begin(), methods.end(), point.method) == methods.end())
            methods.push_back(point.method);
    const auto numberOf = [&](const std::string& method) {
        return static_cast<std::size_t>(std::find(methods.begin(), methods.end(), method) - methods.begin());
    };
    // Strong where a method is on the front: of a dial that is given, with all of its points.
    std::vector<bool> strong = axes.x_is_cost ? front : std::vector<bool>(points.size(), true);
    if (axes.dial_is_given)
        for (std::size_t i = 0; i < points.size(); ++i)
            for (std::size_t j = 0; j < points.size(); ++j)
                if (front[j] && points[i].method == points[j].method) strong[i] = true;

    Labels labels(scale.right_px, theme);
    for (const Point& point : points)
        labels.keepFreeOfPoint(scale.x(point.cost), scale.y(y(point.error)));

    // The front as a step line: what a cost buys, from the cheapest on.
    std::ostringstream data;
    std::ostringstream plot;
    std::vector<const Point*> steps;
    for (std::size_t i = 0; i < points.size(); ++i)
        if (front[i]) steps.push_back(&points[i]);
    std::sort(steps.begin(), steps.end(), [](const Point* a, const Point* b) { return a->cost < b->cost; });
    data << "$front << EOD\n";
    for (std::size_t i = 0; i < steps.size(); ++i) {
        data << exact(steps[i]->cost) << " " << exact(y(steps[i]->error)) << "\n";
        if (i + 1 == steps.size()) break;
        const double left = scale.x(steps[i]->cost);
        const double right = scale.x(steps[i + 1]->cost);
        const double above = scale.y(y(steps[i]->error));
        const double below = scale.y(y(steps[i + 1]->error));
        labels.keepFree({left, above - 1, right, above + 1});
        labels.keepFree({right - 1, above, right + 1, below});
    }
    data << "EOD\n";
    plot << "plot $front with steps lw 2.5 lc rgb '" << mixed(theme.text, theme.background, 0.45)
         << "' notitle";

    // By its place among the chart's methods each has a shape and a colour, so that charts of one family,
    // which show the same methods in the same order, agree.
    constexpr int shapes[] = {7, 5, 9, 11, 13, 15}; // each one's hollow shape is the one before
    const auto shapeOf = [&](std::size_t m) { return shapes[m % std::size(shapes)]; };
    const auto colorOf = [&](std::size_t m) { return std::string(theme.methods[m % theme.methods.size()]); };
    const auto pale = [&](const std::string& color) { return mixed(color, theme.background, 0.5); };

    for (std::size_t m = 0; m < methods.size(); ++m) {
        data << "$curve" << m << " << EOD\n";
        for (const Point& point : points)
            if (point.method == methods[m]) data << exact(point.cost) << " " << exact(y(point.error)) << "\n";
        data << "EOD\n";
        plot << ", \\\n $curve" << m << " with lines lw 1 dt 3 lc rgb '" << pale(colorOf(m)) << "' notitle";
    }
    // What lies behind first, so that the front is on top.
    for (const bool on_front : {false, true})
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (strong[i] != on_front) continue;
            const std::size_t m = numberOf(points[i].method);
            data << "$point" << i << " << EOD\n"
                 << exact(points[i].cost) << " " << exact(y(points[i].error)) << "\nEOD\n";
            plot << ", \\\n $point" << i << " with points pt " << shapeOf(m) - (points[i].hollow ? 1 : 0)
                 << " ps " << (points[i].competes ? "1.05" : "0.6") << " lw 2 lc rgb '"
                 << (on_front ? colorOf(m) : pale(colorOf(m))) << "' notitle";
        }

    // Names. What is marked first, then the front, then the rest; each method once.
    std::vector<bool> named(methods.size());
    std::vector<std::string> in_key(methods.size());
    const auto put = [&](std::size_t i, const std::vector<std::string>& lines, int font_px, bool near) {
        const std::string ink = mixed(colorOf(numberOf(points[i].method)), theme.text, 0.35);
        return labels.put(lines, scale.x(points[i].cost), scale.y(y(points[i].error)), font_px, near,
                          strong[i] ? ink : mixed(ink, theme.background, 0.2));
    };
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (points[i].mark.empty()) continue;
        const std::size_t m = numberOf(points[i].method);
        const bool with_name = points[i].competes && !named[m];
        const auto lines = with_name ? std::vector<std::string>{methods[m], points[i].mark}
                                     : std::vector<std::string>{points[i].mark};
        if (put(i, lines, name_px, false))
            named[m] = named[m] || with_name;
        else
            in_key[m] += (in_key[m].empty() ? "" : ", ") + points[i].mark;
    }
    for (const int round : {0, 1, 2}) // the front, what else competes, the rest
        for (std::size_t i = 0; i < points.size(); ++i) {
            const std::size_t m = numberOf(points[i].method);
            if (!named[m] && round >= (front[i] ? 0 : points[i].competes ? 1 : 2))
                named[m] = put(i, {methods[m]}, name_px, false);
        }
    for (std::size_t i = 0; i < points.size(); ++i) {
        const bool first = i == 0 || points[i - 1].method != points[i].method;
        const bool last = i + 1 == points.size() || points[i + 1].method != points[i].method;
        const bool at_the_bottom = axes.log_y && points[i].error < axes.floor;
        if (!points[i].dial.empty() &&
            ((axes.dial_is_given && !at_the_bottom) || (!axes.dial_is_given && first != last)))
            put(i, {points[i].dial}, dial_px, true);
    }
    missing = false;
    for (std::size_t m = 0; m < methods.size(); ++m) {
        if (named[m] && in_key[m].empty()) continue;
        missing = true;
        plot << ", \\\n NaN with points pt " << shapeOf(m) << " ps 1.05 lw 2 lc rgb '" << colorOf(m)
             << "' title " << inQuotes(methods[m] + (in_key[m].empty() ? "" : ": " + in_key[m]));
    }

    const auto line = [&](const std::string& text, double x, double y_px, int font_px, const char* color,
                          const char* style) {
        std::ostringstream label;
        if (!text.empty())
            label << "set label " << inQuotes(text) << " at " << Labels::screen(x, y_px) << " left font '"
                  << style << "," << font_px << "' tc rgb '" << color << "' noenhanced\n";
        return label.str();
    };
    std::string legend;
    for (const std::string& text :
         {std::string(axes.x_is_cost ? "line: the front, what nothing beats in both" : ""), axes.hollow,
          axes.others})
        if (!text.empty()) legend += (legend.empty() ? "" : "; ") + text;
    std::ostringstream script;
    script << "set encoding utf8\nset terminal svg size " << width << "," << height
           << " dynamic enhanced background rgb '" << theme.background
           << "' font 'sans-serif,14' name 'chart'\n"
           << "set output 'chart.svg'\n"
           << "set lmargin at screen " << exact(plot_left / width) << "\nset rmargin at screen "
           << exact(scale.right_px / width) << "\nset tmargin at screen " << exact(1 - plot_top / height)
           << "\nset bmargin at screen " << exact(1 - plot_bottom / height) << "\n"
           << data.str() << line(axes.title, 14, 18, 17, theme.text, "sans-serif")
           << line(axes.subtitle, 14, 40, 13, theme.faint_text, "sans-serif")
           << line(legend, 14, 509, 12, theme.faint_text, "sans-serif") << labels.script() << "set xlabel "
           << inQuotes(axes.x) << " noenhanced tc rgb '" << theme.text << "'\nset ylabel " << inQuotes(axes.y)
           << " noenhanced tc rgb '" << theme.text << "'\n"
           << "set key at screen " << exact((scale.right_px + 8) / width) << ","
           << exact(1 - plot_top / height)
           << " left top Left reverse spacing 1.25 samplen 1 font ',12' tc rgb '" << theme.text
           << "' noenhanced\n"
           << "set grid lc rgb '" << theme.grid << "' lw 1\nset border 3 lc rgb '" << theme.faint_text
           << "'\nset tics nomirror tc rgb '" << theme.text << "'\nset xrange [" << exact(scale.x_begin)
           << ":" << exact(scale.x_end) << "]\nset yrange [" << exact(scale.y_begin) << ":"
           << exact(scale.y_end) << "]\n";
    if (axes.log_y) {
        script << "set logscale y\nset format y '%g'\n";
        if (std::any_of(points.begin(), points.end(), [&](const Point& p) { return p.error < axes.floor; }))
            script << "set ytics add ('≤ " << exact(axes.floor) << "' " << exact(axes.floor) << ")\n";
    }
    if (axes.log_x) script << "set logscale x\nset format x '%g'\n";
    script << plot.str() << "\n";
    return script.str();
}

} // namespace

void drawChart(const std::filesystem::path& file, const Axes& axes, const std::vector<Point>& points) {
    if (points.empty() || (axes.log_y && !(axes.floor > 0)))
        throw std::invalid_argument(file.string() + ": a chart needs points, a logarithmic one a bottom");
    if (axes.log_x && std::any_of(points.begin(), points.end(), [](const Point& p) { return !(p.cost > 0); }))
        throw std::invalid_argument(file.string() +
                                    ": what costs nothing has no place on a logarithmic axis");
    for (const Theme& theme : themes) {
        bool missing = false;
        std::string script = chartScript(axes, points, theme, false, missing);
        if (missing) script = chartScript(axes, points, theme, true, missing);
        const test::TemporaryFolder folder;
        folder.write("chart.gp", script);
        test::runToSuccess(
            {.program = "/usr/bin/env", .arguments = {"gnuplot", "chart.gp"}, .folder = folder.path()});
        std::filesystem::path target = file;
        target.replace_filename(file.stem().string() + theme.file_ending + ".svg");
        std::filesystem::copy_file(folder / "chart.svg", target,
                                   std::filesystem::copy_options::overwrite_existing);
    }
    std::filesystem::path json = file;
    writeChartJson(json.replace_extension(".json"), axes, points);
}

} // namespace gll::charts
