// Charts by Dear ImGui's own drawing.
#include "window/chart_view.hpp"

#include "window/ui.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <imgui.h>
#include <optional>
#include <stdexcept>

namespace gll {
namespace {

constexpr ImU32 text_color = IM_COL32(226, 230, 236, 255);
constexpr ImU32 faint_color = IM_COL32(150, 156, 166, 255);
constexpr ImU32 grid_color = IM_COL32(58, 62, 70, 255);
constexpr ImU32 fine_grid_color = IM_COL32(44, 47, 53, 255);
constexpr ImU32 front_color = IM_COL32(170, 176, 186, 255);
constexpr ImU32 plot_color = IM_COL32(23, 25, 28, 255);

// As the page's dark pictures have them: colours that colour-blind readers tell apart (Okabe, Ito, "Color
// Universal Design", 2008).
constexpr std::array<ImU32, 7> method_colors = {IM_COL32(240, 127, 46, 255),  IM_COL32(74, 159, 224, 255),
                                                IM_COL32(31, 191, 146, 255),  IM_COL32(221, 146, 187, 255),
                                                IM_COL32(255, 255, 255, 255), IM_COL32(230, 159, 0, 255),
                                                IM_COL32(143, 208, 245, 255)};

ImU32 withAlpha(ImU32 color, int alpha) {
    return (color & ~IM_COL32_A_MASK) | (static_cast<ImU32>(alpha) << IM_COL32_A_SHIFT);
}

std::string shortNumber(double value) {
    char buffer[40];
    std::snprintf(buffer, sizeof buffer, "%.4g", value);
    return buffer;
}

std::string roundNumber(double value) {
    char buffer[40];
    std::snprintf(buffer, sizeof buffer, "%.3g", value);
    return buffer;
}

// An axis' range, and how far along it a value is: 0 to 1.
struct Range {
    double begin = 0;
    double end = 1;
    bool is_log = false;

    float part(double value) const {
        return static_cast<float>(is_log ? std::log(value / begin) / std::log(end / begin)
                                         : (value - begin) / (end - begin));
    }
    bool holds(double value) const { return value >= begin * 0.999 && value <= end * 1.001; }
};

Range rangeOf(const ChartAxis& axis, const std::vector<double>& values) {
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    Range range{.is_log = axis.is_log};
    if (axis.is_log) {
        range.begin = axis.floor > 0 ? axis.floor : *least / 1.8;
        range.end = std::max(*most, range.begin) * 1.8;
    } else {
        range.begin = std::min(*least, 0.0);
        range.end = *most > range.begin ? *most + 0.1 * (*most - range.begin) : range.begin + 1;
    }
    return range;
}

// Where an axis has numbers: at powers of ten, with their doubles and fives where these are few; or at round
// steps.
std::vector<double> ticks(const Range& range) {
    std::vector<double> all;
    if (range.is_log) {
        const double decades = std::log10(range.end / range.begin);
        for (double power = std::pow(10, std::floor(std::log10(range.begin))); power <= range.end;
             power *= 10)
            for (const double digit : {1.0, 2.0, 5.0})
                if ((digit == 1 || decades < 2) && range.holds(power * digit)) all.push_back(power * digit);
        return all;
    }
    const double rough = (range.end - range.begin) / 5;
    const double power = std::pow(10, std::floor(std::log10(rough)));
    double step = 10 * power;
    for (const double digit : {5.0, 2.0, 1.0})
        if (digit * power >= rough) step = digit * power;
    for (double i = std::ceil(range.begin / step); i * step <= range.end; ++i)
        all.push_back(i * step);
    return all;
}

struct Box {
    ImVec2 low, high;

    bool overlaps(const Box& other) const {
        return low.x < other.high.x && other.low.x < high.x && low.y < other.high.y && other.low.y < high.y;
    }
    bool holds(const Box& other) const {
        return low.x <= other.low.x && low.y <= other.low.y && high.x >= other.high.x &&
               high.y >= other.high.y;
    }
};

// By its place among the chart's methods each has a shape and a colour, as in the page's picture.
class Methods {
  public:
    explicit Methods(const Chart& chart) {
        for (const ChartPoint& point : chart.points)
            if (std::find(names_.begin(), names_.end(), point.method) == names_.end())
                names_.push_back(point.method);
    }
    ImU32 color(const ChartPoint& point) const { return method_colors[number(point) % method_colors.size()]; }

    void shape(ImDrawList& list, const ChartPoint& point, ImVec2 at, float radius, int alpha) const {
        const ImU32 ink = withAlpha(color(point), alpha);
        const auto corner = [&](float x, float y) { return ImVec2(at.x + x * radius, at.y + y * radius); };
        switch (number(point) % 6) {
        case 0:
            list.AddCircleFilled(at, radius, ink, 16);
            break;
        case 1:
            list.AddRectFilled(corner(-0.85F, -0.85F), corner(0.85F, 0.85F), ink);
            break;
        case 2:
            list.AddTriangleFilled(corner(0, -1.15F), corner(1.1F, 0.85F), corner(-1.1F, 0.85F), ink);
            break;
        case 3:
            list.AddTriangleFilled(corner(0, 1.15F), corner(-1.1F, -0.85F), corner(1.1F, -0.85F), ink);
            break;
        case 4:
            list.AddNgonFilled(at, radius * 1.2F, ink, 4);
            break;
        default:
            list.AddNgonFilled(at, radius * 1.1F, ink, 5);
        }
    }

  private:
    std::size_t number(const ChartPoint& point) const {
        return static_cast<std::size_t>(std::find(names_.begin(), names_.end(), point.method) -
                                        names_.begin());
    }

    std::vector<std::string> names_;
};

// One chart in one place of the screen.
class Plot {
  public:
    Plot(const Chart& chart, const std::optional<CostsHere>& here, ImVec2 low, ImVec2 size)
        : chart_(chart), here_(here), methods_(chart), list_(*ImGui::GetWindowDrawList()),
          em_(ImGui::GetFontSize()) {
        std::vector<double> xs, ys;
        if (here) {
            xs = here->points;
            xs.push_back(here->present);
            if (chart.x.is_log) std::erase_if(xs, [](double x) { return x <= 0; });
        }
        for (const ChartPoint& point : chart.points) {
            xs.push_back(point.x);
            ys.push_back(std::max(point.y, chart.y.floor));
        }
        x_ = rangeOf(chart.x, xs);
        y_ = rangeOf(chart.y, ys);
        float widest = 0;
        for (const double tick : ticks(y_))
            widest = std::max(widest, ImGui::CalcTextSize(shortNumber(tick).c_str()).x);
        plot_ = {{low.x + widest + 0.5F * em_, low.y + 1.3F * em_},
                 {low.x + size.x - 0.3F * em_, low.y + size.y - 2.6F * em_}};
    }

    ImVec2 place(const ChartPoint& point) const { return place(point, point.x); }
    ImVec2 place(const ChartPoint& point, double x) const {
        const double y = std::max(point.y, chart_.y.floor);
        return {plot_.low.x + (plot_.high.x - plot_.low.x) * x_.part(x),
                plot_.high.y - (plot_.high.y - plot_.low.y) * y_.part(y)};
    }

    // The point that is nearest to a place, within reach.
    std::optional<std::size_t> nearest(ImVec2 to) const {
        std::optional<std::size_t> found;
        float least = 0.9F * em_;
        for (std::size_t i = 0; i < chart_.points.size(); ++i) {
            const ImVec2 at = place(chart_.points[i]);
            const float distance = std::hypot(at.x - to.x, at.y - to.y);
            if (distance >= least) continue;
            least = distance;
            found = i;
        }
        return found;
    }

    void draw(const std::vector<bool>& present, std::optional<std::size_t> pointed_at) {
        list_.AddRectFilled(plot_.low, plot_.high, plot_color);
        drawGrid();
        list_.PushClipRect(plot_.low, plot_.high, true);
        drawLines();
        for (const bool on_front : {false, true}) // the front on top
            for (const ChartPoint& point : chart_.points)
                if (point.is_on_front == on_front)
                    methods_.shape(list_, point, place(point), (point.competes ? 0.3F : 0.18F) * em_,
                                   on_front ? 255 : 120);
        if (here_) drawHere();
        list_.PopClipRect();
        for (std::size_t i = 0; i < chart_.points.size(); ++i) {
            const ImVec2 at = place(chart_.points[i]);
            if (present[i]) list_.AddCircle(at, 0.55F * em_, text_color, 24, 0.14F * em_);
            if (i == pointed_at) list_.AddCircle(at, 0.55F * em_, faint_color, 24, 0.09F * em_);
        }
        drawLabels(present);
    }

    const Methods& methods() const { return methods_; }

  private:
    void text(ImVec2 at, ImU32 color, const std::string& words) { list_.AddText(at, color, words.c_str()); }

    void drawGrid() {
        const auto vertical = [&](double value, ImU32 color) {
            const float x = plot_.low.x + (plot_.high.x - plot_.low.x) * x_.part(value);
            list_.AddLine({x, plot_.low.y}, {x, plot_.high.y}, color);
            return x;
        };
        const auto horizontal = [&](double value, ImU32 color) {
            const float y = plot_.high.y - (plot_.high.y - plot_.low.y) * y_.part(value);
            list_.AddLine({plot_.low.x, y}, {plot_.high.x, y}, color);
            return y;
        };
        const auto fine = [](const Range& range, const auto& line) { // nine lines a decade
            if (!range.is_log) return;
            for (double power = std::pow(10, std::floor(std::log10(range.begin))); power <= range.end;
                 power *= 10)
                for (int digit = 1; digit < 10; ++digit)
                    if (range.holds(power * digit)) line(power * digit, fine_grid_color);
        };
        fine(x_, vertical);
        fine(y_, horizontal);
        float free_from = plot_.low.x - em_; // of numbers along x
        for (const double tick : ticks(x_)) {
            const float x = vertical(tick, grid_color);
            const std::string number = shortNumber(tick);
            const float width = ImGui::CalcTextSize(number.c_str()).x;
            const float left = std::min(x - width / 2, plot_.high.x + 0.3F * em_ - width);
            if (left < free_from) continue;
            text({left, plot_.high.y + 0.15F * em_}, faint_color, number);
            free_from = left + width + 0.4F * em_;
        }
        float free_below = plot_.high.y + em_;
        for (const double tick : ticks(y_)) {
            const float y = horizontal(tick, grid_color);
            const std::string number = shortNumber(tick);
            const ImVec2 size = ImGui::CalcTextSize(number.c_str());
            if (y + size.y / 2 > free_below) continue;
            text({plot_.low.x - size.x - 0.25F * em_, y - size.y / 2}, faint_color, number);
            free_below = y - size.y / 2;
        }
        text({plot_.low.x, plot_.low.y - 1.2F * em_}, text_color, chart_.y.label);
        const float width = ImGui::CalcTextSize(chart_.x.label.c_str()).x;
        text({std::max(plot_.high.x - width, plot_.low.x - 3 * em_), plot_.high.y + 1.3F * em_}, text_color,
             chart_.x.label);
    }

    // A method's points in the order of its dial, and the front as steps: what a cost buys.
    void drawLines() {
        for (std::size_t i = 0; i + 1 < chart_.points.size(); ++i)
            if (chart_.points[i].method == chart_.points[i + 1].method)
                list_.AddLine(place(chart_.points[i]), place(chart_.points[i + 1]),
                              withAlpha(methods_.color(chart_.points[i]), 90), 0.06F * em_);
        std::vector<ImVec2> front;
        for (const ChartPoint& point : chart_.points)
            if (point.is_on_front) front.push_back(place(point));
        std::sort(front.begin(), front.end(), [](ImVec2 one, ImVec2 other) {
            return one.x < other.x || (one.x == other.x && one.y < other.y);
        });
        for (std::size_t i = 0; i + 1 < front.size(); ++i) {
            const ImVec2 corner(front[i + 1].x, front[i].y);
            list_.AddLine(front[i], corner, front_color, 0.1F * em_);
            list_.AddLine(corner, front[i + 1], front_color, 0.1F * em_);
        }
    }

    // Where this machine has the points, and what the present settings cost: how far off those are, nobody
    // measured unless they are a point's.
    void drawHere() {
        std::size_t next = 0;
        for (const ChartPoint& point : chart_.points) {
            if (point.values.empty()) continue;
            const double x = here_->points[next++];
            if (chart_.x.is_log && x <= 0) continue;
            list_.AddLine(place(point), place(point, x), withAlpha(text_color, 110), 0.06F * em_);
            list_.AddCircle(place(point, x), 0.2F * em_, withAlpha(text_color, 200), 12, 0.08F * em_);
        }
        if (chart_.x.is_log && here_->present <= 0) return;
        const float x = plot_.low.x + (plot_.high.x - plot_.low.x) * x_.part(here_->present);
        for (float y = plot_.low.y; y < plot_.high.y; y += 0.6F * em_)
            list_.AddLine({x, y}, {x, std::min(y + 0.35F * em_, plot_.high.y)}, text_color, 0.12F * em_);
    }

    // Beside their points where they cover nothing: what is marked, then the present, then the front's
    // methods.
    void drawLabels(const std::vector<bool>& present) {
        std::vector<Box> taken;
        for (const ChartPoint& point : chart_.points) {
            const ImVec2 at = place(point);
            taken.push_back(
                {{at.x - 0.35F * em_, at.y - 0.35F * em_}, {at.x + 0.35F * em_, at.y + 0.35F * em_}});
        }
        std::vector<std::string> written;
        const auto put = [&](std::size_t i, const std::string& words, ImU32 color) {
            if (words.empty() || std::find(written.begin(), written.end(), words) != written.end()) return;
            const ImVec2 at = place(chart_.points[i]);
            const ImVec2 size = ImGui::CalcTextSize(words.c_str());
            const float gap = 0.7F * em_; // beyond the ring of the present
            for (const ImVec2 low :
                 {ImVec2(at.x + gap, at.y - size.y / 2), ImVec2(at.x - gap - size.x, at.y - size.y / 2),
                  ImVec2(at.x - size.x / 2, at.y - gap - size.y), ImVec2(at.x - size.x / 2, at.y + gap),
                  ImVec2(at.x + gap, at.y - gap - size.y), ImVec2(at.x + gap, at.y + gap),
                  ImVec2(at.x - gap - size.x, at.y - gap - size.y),
                  ImVec2(at.x - gap - size.x, at.y + gap)}) {
                const Box box{low, {low.x + size.x, low.y + size.y}};
                if (!plot_.holds(box) || std::any_of(taken.begin(), taken.end(),
                                                     [&](const Box& other) { return other.overlaps(box); }))
                    continue;
                list_.AddRectFilled(box.low, box.high, withAlpha(plot_color, 190)); // over lines
                text(low, color, words);
                taken.push_back(box);
                written.push_back(words);
                return;
            }
        };
        for (std::size_t i = 0; i < chart_.points.size(); ++i)
            put(i, chart_.points[i].mark, text_color);
        for (std::size_t i = 0; i < chart_.points.size(); ++i)
            if (present[i]) put(i, "now", text_color);
        for (std::size_t i = 0; i < chart_.points.size(); ++i)
            if (chart_.points[i].is_on_front)
                put(i, chart_.points[i].method, methods_.color(chart_.points[i]));
    }

    const Chart& chart_;
    const std::optional<CostsHere>& here_;
    Methods methods_;
    ImDrawList& list_;
    float em_;
    Range x_, y_;
    Box plot_;
};

std::string nameOf(const ChartPoint& point) {
    return point.method + (point.dial.empty() ? "" : ", " + point.dial);
}

std::string markedNameOf(const ChartPoint& point) {
    const bool says_more = !point.mark.empty() && point.mark != point.method;
    return nameOf(point) + (says_more ? " (" + point.mark + ")" : "");
}

// Beside the panel, at the height of the mouse: the chart stays in sight.
void pointTooltip(const Chart& chart, const ChartPoint& point, bool is_present, const std::string& rung) {
    std::string text = markedNameOf(point);
    text += "\n" + chart.x.label + ": " + shortNumber(point.x) + "\n" + chart.y.label + ": " +
            shortNumber(point.y);
    for (const auto& [name, value] : point.settings)
        text += "\n--set " + name + "=" + value;
    if (is_present)
        text += "\nThese are the present settings.";
    else if (!point.values.empty())
        text += "\nClick to take these settings.";
    else if (!point.rung.empty() && point.rung != rung)
        text += "\n" + point.rung + " draws it.";
    const float em = ImGui::GetFontSize();
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const ImVec2 padding = ImGui::GetStyle().WindowPadding;
    const float right = ImGui::GetWindowPos().x + ImGui::GetWindowSize().x + em;
    const bool is_beside = display.x - right > 16 * em;
    const float wrap =
        std::max(std::min(28 * em, (is_beside ? display.x - right : display.x) - 2 * padding.x), 1.0F);
    const ImVec2 size = ImGui::CalcTextSize(text.c_str(), nullptr, false, wrap);
    const ImVec2 mouse = ImGui::GetMousePos();
    ImVec2 at(is_beside ? right : mouse.x + em, is_beside ? mouse.y - em : mouse.y + 1.5F * em);
    at.x = std::clamp(at.x, 0.0F, std::max(display.x - size.x - 2 * padding.x, 0.0F));
    at.y = std::clamp(at.y, 0.0F, std::max(display.y - size.y - 2 * padding.y, 0.0F));
    ImGui::SetNextWindowPos(at);
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(padding.x + wrap);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

// Every point as a line, for the keyboard and for who wants the numbers. The one that was chosen, and the one
// under the mouse.
struct Listed {
    std::optional<std::size_t> chosen, pointed_at;
};
Listed drawList(const Chart& chart, const Methods& methods, const std::vector<bool>& present,
                const std::string& rung) {
    Listed listed;
    const float em = ImGui::GetFontSize();
    if (!ImGui::BeginTable("points", 3, ImGuiTableFlags_NoSavedSettings)) return listed;
    ImGui::TableSetupColumn("method", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableSetupColumn("x", ImGuiTableColumnFlags_WidthFixed, 3.2F * em);
    ImGui::TableSetupColumn("y", ImGuiTableColumnFlags_WidthFixed, 3.6F * em);
    for (std::size_t i = 0; i < chart.points.size(); ++i) {
        const ChartPoint& point = chart.points[i];
        ImGui::PushID(static_cast<int>(i));
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        const ImVec2 at = ImGui::GetCursorScreenPos();
        methods.shape(*ImGui::GetWindowDrawList(), point, {at.x + 0.4F * em, at.y + 0.5F * em}, 0.28F * em,
                      point.is_on_front ? 255 : 120);
        ImGui::Indent(em);
        ImGui::BeginDisabled(point.values.empty());
        if (ImGui::Selectable(nameOf(point).c_str(), present[i], ImGuiSelectableFlags_SpanAllColumns))
            listed.chosen = i;
        ImGui::EndDisabled();
        const bool is_hovered = ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled);
        if (is_hovered) pointTooltip(chart, point, present[i], rung);
        if (is_hovered || ImGui::IsItemFocused()) listed.pointed_at = i;
        ImGui::Unindent(em);
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(shortNumber(point.x).c_str());
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(shortNumber(point.y).c_str());
        ImGui::PopID();
    }
    ImGui::EndTable();
    return listed;
}

std::vector<std::string> changesFor(const ChartPoint& point, const Settings& settings) {
    std::vector<std::string> sets;
    for (const auto& [place, value] : point.values) {
        Setting setting = settings.all()[place];
        if (setting.value == value) continue;
        setting.value = value;
        sets.push_back(setting.name + "=" + setting.text());
    }
    return sets;
}

} // namespace

ChartView::ChartView(const Resources& resources, const std::string& rung, Settings& settings) : rung_(rung) {
    try {
        charts_ = chartsOf(resources.find("tutorials"), rung, settings);
        if (charts_.empty()) why_none_ = "There are no charts of this rung.";
    } catch (const std::exception& error) {
        why_none_ = error.what();
    }
}

std::vector<std::vector<std::string>> ChartView::wanted() const {
    if (charts_.empty() || !countsCopies(charts_[shown_])) return {};
    return drawablePoints(charts_[shown_]);
}

std::vector<std::string> ChartView::draw(const Settings& settings,
                                         const std::optional<CostProbe::Costs>& points,
                                         const std::optional<CostProbe::Costs>& present_costs,
                                         bool is_counting) {
    if (charts_.empty()) {
        wrappedText(why_none_);
        return {};
    }
    const float em = ImGui::GetFontSize();
    if (charts_.size() > 1) {
        if (ImGui::ArrowButton("##before", ImGuiDir_Left)) shown_ += charts_.size() - 1;
        ImGui::SameLine();
        if (ImGui::ArrowButton("##after", ImGuiDir_Right)) ++shown_;
        shown_ %= charts_.size();
        ImGui::SameLine();
        ImGui::AlignTextToFramePadding();
        ImGui::TextDisabled("chart %zu of %zu", shown_ + 1, charts_.size());
    }
    const Chart& chart = charts_[shown_];
    Ui::pushBold();
    wrappedText(chart.title);
    Ui::popFont();
    const float width = std::max(ImGui::GetContentRegionAvail().x, 8 * em);
    const ImVec2 low = ImGui::GetCursorScreenPos();
    const ImVec2 size(width, std::clamp(0.8F * width, 12 * em, 24 * em));
    const std::size_t drawable = wanted().size(); // costs of another chart may come in a last time
    std::optional<CostsHere> here;
    if (points && present_costs && drawable > 0 && points->cu.size() == drawable)
        here = costsHere(chart, points->cu, present_costs->cu[0]);
    Plot plot(chart, here, low, size);
    std::vector<bool> present;
    for (const ChartPoint& point : chart.points)
        present.push_back(isPresent(point, settings));

    // Under it in code and beside it in the picture: a list that tells which point the keyboard is at.
    const bool is_pressed = ImGui::InvisibleButton("##plot", size);
    std::optional<std::size_t> pointed_at, chosen;
    if (ImGui::IsItemHovered()) {
        pointed_at = plot.nearest(ImGui::GetMousePos());
        if (pointed_at) {
            pointTooltip(chart, chart.points[*pointed_at], present[*pointed_at], rung_);
            if (!chart.points[*pointed_at].values.empty()) ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
            if (is_pressed) chosen = pointed_at;
        }
    }
    ImGui::PushStyleColor(ImGuiCol_Text, faint_color);
    wrappedText(chart.subtitle);
    ImGui::PopStyleColor();
    std::string now;
    for (std::size_t i = 0; i < present.size() && now.empty(); ++i)
        if (present[i]) now = "Now: " + markedNameOf(chart.points[i]);
    wrappedText(now.empty() ? "The present settings are none of its points." : now);
    if (ImGui::TreeNode("All points")) {
        const Listed listed = drawList(chart, plot.methods(), present, rung_);
        if (listed.chosen) chosen = listed.chosen;
        if (listed.pointed_at) pointed_at = listed.pointed_at;
        ImGui::TreePop();
    }
    // Below, and as high before it is known: it moves nothing.
    if (drawable > 0 && (here || is_counting)) {
        ImGui::PushStyleColor(ImGuiCol_Text, faint_color);
        std::string counted = "Counting the points on this machine ...";
        if (here)
            counted = "Here, by " + points->counter +
                      ": the dashed line is what the present settings cost, " + roundNumber(here->present) +
                      " cu; small rings are the points. The rest of the frame, " + roundNumber(here->shared) +
                      " cu, is left out.";
        const float top = ImGui::GetCursorPosY();
        wrappedText(counted);
        ImGui::PopStyleColor();
        ImGui::SetCursorPosY(std::max(ImGui::GetCursorPosY(), top + 3 * ImGui::GetTextLineHeight() +
                                                                  ImGui::GetStyle().ItemSpacing.y));
    }
    plot.draw(present, pointed_at);
    return chosen ? changesFor(chart.points[*chosen], settings) : std::vector<std::string>();
}

} // namespace gll
