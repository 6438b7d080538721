// Thumbnails as passes are drawn, and looking into one target.
#include "window/inspector.hpp"

#include "window/ui.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <imgui.h>
#include <utility>

namespace gll {
namespace {

constexpr float bar_em = 2;
constexpr double nearest_pixels_per_texel = 64;
constexpr double contents_every_s = 0.5;

ImTextureID imageOf(const Texture& texture) {
    return (ImTextureID)(std::intptr_t)
        texture.id(); // a pointer or a number, as the version of Dear ImGui has it
}

std::string describe(const Texture& texture) {
    const FormatInfo info = formatInfo(texture.format());
    return std::string(info.name) + ", " + std::to_string(texture.size().x) + "x" +
           std::to_string(texture.size().y);
}

// A shadow map is read as depth, not as what a comparison with it gives.
class WithoutComparison {
  public:
    explicit WithoutComparison(const Texture& texture) : texture_(texture) { set(GL_NONE); }
    ~WithoutComparison() { set(GL_COMPARE_REF_TO_TEXTURE); }
    WithoutComparison(const WithoutComparison&) = delete;
    WithoutComparison& operator=(const WithoutComparison&) = delete;

  private:
    void set(GLenum mode) const {
        if (!texture_.description().compare_depth) return;
        glBindTexture(GL_TEXTURE_2D, texture_.id());
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, static_cast<GLint>(mode));
        glBindTexture(GL_TEXTURE_2D, 0);
    }
    const Texture& texture_;
};

} // namespace

void Inspector::begin(Renderer& renderer, glm::ivec2 thumbnail_px) {
    renderer_ = &renderer;
    drawn_.clear();
    thumbnail_px_ = glm::max(thumbnail_px, glm::ivec2(1));
}

void Inspector::after(const DrawnPass& pass) {
    const auto& attachments = pass.target->attachments();
    for (std::size_t i = 0; i < attachments.size(); ++i) {
        if (isSelected(pass, i)) takeCopy(pass, i);
        const Texture& texture = pass.target->texture(i);
        const int row = static_cast<int>(drawn_.size());
        drawn_.push_back({{pass.name, attachments[i].name}, describe(texture)});
        const glm::vec2 size(texture.size());
        const glm::vec2 room(thumbnail_px_);
        const float texels_per_pixel = std::max(size.x / room.x, size.y / room.y);
        View view;
        view.corner = (size - room * texels_per_pixel) * 0.5F;
        view.texels_per_pixel = texels_per_pixel;
        view.is_display = &texture == &renderer_->presented().color();
        view.depth = formatInfo(attachments[i].format).is_depth ? 1 : 0;
        if ((row + 1) * thumbnail_px_.y > atlas_.size().y || thumbnail_px_.x != atlas_.size().x) continue;
        drawInto(atlas_, texture, {{0, row * thumbnail_px_.y}, thumbnail_px_}, view);
    }
}

void Inspector::end() {
    // Room for as many as there were, for the next frame.
    const glm::ivec2 size(thumbnail_px_.x,
                          thumbnail_px_.y * std::max<int>(static_cast<int>(drawn_.size()), 1));
    wants_frame_ = atlas_.size() != size;
    if (wants_frame_) atlas_.remake({{.name = "thumbnails", .format = Format::rgba8}}, size);
    thumbnails_ = std::exchange(drawn_, {});
    is_found_ = selected_ && std::any_of(thumbnails_.begin(), thumbnails_.end(),
                                         [&](const Thumbnail& one) { return one.target == *selected_; });
}

bool Inspector::isSelected(const DrawnPass& pass, std::size_t attachment) const {
    return selected_ && selected_->pass == pass.name &&
           selected_->name == pass.target->attachments()[attachment].name;
}

void Inspector::takeCopy(const DrawnPass& pass, std::size_t attachment) {
    const Texture& texture = pass.target->texture(attachment);
    const Attachment& drawn = pass.target->attachments()[attachment];
    levels_ = drawn.mipmapped ? levelCount(texture.size()) : 1;
    level_ = std::min(level_, levels_ - 1);
    copy_.take(texture, level_);
    how_.is_display = &texture == &renderer_->presented().color();
    described_ = describe(texture);
}

void Inspector::drawInto(const Framebuffer& target, const Texture& source, const Viewport& viewport,
                         const View& view) {
    const FormatInfo info = formatInfo(source.format());
    const WithoutComparison scope(source);
    const bool is_light = (info.is_float || source.format() == Format::srgb8_alpha8) && !view.is_display;
    const Program& program =
        renderer_->shaders().fullScreen("window/inspect.frag", {{"TAPS", std::to_string(view.taps)}});
    drawPass("inspector", target,
             {.program = program,
              .inputs = {{"source", source}},
              .uniforms = {{"view_corner_px", glm::vec2(viewport.corner)},
                           {"corner", view.corner},
                           {"texels_per_pixel", view.texels_per_pixel},
                           {"exposure", std::exp2(view.exposure_ev)},
                           {"channel", view.channel},
                           {"as_stops", view.as_stops ? 1 : 0},
                           {"encode_srgb", is_light ? 1 : 0},
                           {"depth", view.depth},
                           {"depth_range", view.depth_range},
                           {"channels", info.channels}},
              .viewport = viewport},
             renderer_->fullScreenTriangle());
}

void Inspector::select(std::optional<PassTarget> target) {
    selected_ = std::move(target);
    level_ = 0;
    how_ = {};
    fits_ = true;
    wants_frame_ = true;
    counted_ = {};
}

void Inspector::fit() {
    const glm::dvec2 size(copy_.size());
    pixels_per_texel_ = std::min({view_.size.x / size.x, view_.size.y / size.y, nearest_pixels_per_texel});
    center_ = size * 0.5;
}

glm::dvec2 Inspector::texelAt(glm::dvec2 cursor) const {
    const glm::dvec2 middle = glm::dvec2(view_.corner) + glm::dvec2(view_.size) * 0.5;
    const glm::dvec2 from_middle(cursor.x - middle.x, middle.y - cursor.y);
    return center_ + from_middle / pixels_per_texel_;
}

void Inspector::drag(glm::dvec2 moved_px) {
    fits_ = false;
    center_ -= glm::dvec2(moved_px.x, -moved_px.y) / pixels_per_texel_;
    center_ = glm::clamp(center_, glm::dvec2(0), glm::dvec2(copy_.size()));
}

void Inspector::zoom(double steps, glm::dvec2 cursor) {
    const glm::dvec2 before = texelAt(cursor);
    fits_ = false;
    pixels_per_texel_ =
        std::clamp(pixels_per_texel_ * std::pow(1.25, steps), 1.0 / 64, nearest_pixels_per_texel);
    center_ += before - texelAt(cursor);
}

void Inspector::look(Renderer& renderer, const Rectangle& picture, glm::dvec2 cursor) {
    renderer_ = &renderer;
    const int bar = std::min(bar_px_, picture.size.y);
    view_ = {{picture.corner.x, picture.corner.y + bar}, {picture.size.x, picture.size.y - bar}};
    cursor_ = cursor;
    if (!is_found_ || !copy_.isTaken() || !view_.isShown()) return;
    if (fits_) fit();
    looked_.resize(view_.size);
    how_.texels_per_pixel = static_cast<float>(1 / pixels_per_texel_);
    how_.corner = glm::vec2(center_ - glm::dvec2(view_.size) * 0.5 / pixels_per_texel_);
    how_.taps = pixels_per_texel_ >= 1 ? 1 : 2;
    const auto now = std::chrono::steady_clock::now();
    if (std::chrono::duration<double>(now - counted_).count() > contents_every_s) {
        contents_ = copy_.contents();
        counted_ = now;
    }
    how_.depth = !copy_.format().is_depth ? 0 : is_perspective_ ? 2 : 1;
    how_.depth_range = {1 / (1 - contents_.nearest), 1 / (1 - contents_.farthest)};
    drawInto(looked_, copy_.texture(), {{0, 0}, view_.size}, how_);
}

void Inspector::drawBar(const Rectangle& picture, float pixels_per_unit, float em_px) {
    bar_px_ = static_cast<int>(std::lround(bar_em * em_px));
    const float em = ImGui::GetFontSize();
    nextWindowAt({picture.corner, {picture.size.x, bar_px_}}, pixels_per_unit);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.4F * em, 0.25F * em});
    ImGui::Begin("##inspected", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoBringToFrontOnFocus);
    if (ImGui::Button("Picture")) select(std::nullopt);
    tooltip("back to the picture; Esc");
    if (selected_) {
        ImGui::SameLine();
        Ui::pushBold();
        ImGui::TextUnformatted(selected_->name.c_str());
        Ui::popFont();
    }
    if (selected_ && !is_found_) {
        ImGui::SameLine();
        ImGui::TextUnformatted("is not drawn with these settings");
    } else if (selected_) {
        viewChoices();
    }
    ImGui::End();
    ImGui::PopStyleVar();
}

void Inspector::viewChoices() {
    const float em = ImGui::GetFontSize();
    ImGui::SameLine();
    if (ImGui::Button("Fit")) fits_ = true;
    ImGui::SameLine();
    if (ImGui::Button("1:1")) {
        fits_ = false;
        pixels_per_texel_ = 1;
    }
    if (levels_ > 1) {
        ImGui::SameLine();
        ImGui::SetNextItemWidth(5 * em);
        if (ImGui::SliderInt("##level", &level_, 0, levels_ - 1, "level %d")) wants_frame_ = true;
    }
    constexpr const char* names[] = {"RGB", "R", "G", "B", "A"};
    for (int i = -1; copy_.format().channels > 1 && i < copy_.format().channels; ++i) {
        ImGui::SameLine(0, i < 0 ? -1 : 0.1F * em);
        const bool is_chosen = how_.channel == i;
        if (is_chosen) ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetColorU32(ImGuiCol_SliderGrab));
        if (ImGui::Button(names[i + 1])) how_.channel = i;
        if (is_chosen) ImGui::PopStyleColor();
    }
    ImGui::SameLine();
    ImGui::SetNextItemWidth(6 * em);
    ImGui::SliderFloat("##exposure", &how_.exposure_ev, -16, 16, "%+.1f EV");
    ImGui::SameLine();
    if (copy_.format().is_depth) {
        ImGui::Checkbox("Perspective", &is_perspective_);
        tooltip(
            "the distance from the eye, black the nearest that was drawn and white the farthest; else the "
            "inverse of the distance, for parallel projections too");
    } else {
        ImGui::Checkbox("Stops", &how_.as_stops);
        tooltip("luminance in false colours, one a stop: violet is 8 stops below middle grey, red 8 above");
    }
    if (contents_.no_number + contents_.infinite > 0) {
        ImGui::SameLine();
        ImGui::TextColored({1, 0.4F, 1, 1}, "%d not a number, %d infinite", contents_.no_number,
                           contents_.infinite);
    }
    ImGui::SameLine();
    ImGui::TextDisabled("after %s: %s", selected_->pass.c_str(), described_.c_str());
}

// What is under the cursor, in words.
std::string Inspector::probe(const std::string& name, const Framebuffer& presented,
                             std::optional<glm::ivec2> picture_texel) const {
    const auto line = [](const std::string& what, glm::ivec2 texel, int height, const std::string& value) {
        return what + " " + std::to_string(texel.x) + "," + std::to_string(height - 1 - texel.y) + ":  " +
               value;
    };
    if (!selected_) {
        if (!picture_texel) return {};
        return line(name, *picture_texel, presented.size().y,
                    describe(readTexel(presented.color(), *picture_texel), false, true));
    }
    if (!is_found_ || !copy_.isTaken() || !view_.contains(cursor_)) return {};
    const glm::ivec2 texel(glm::floor(texelAt(cursor_)));
    if (texel.x < 0 || texel.y < 0 || texel.x >= copy_.size().x || texel.y >= copy_.size().y) return {};
    const Texel value = readTexel(copy_.texture(), texel);
    std::string text = line(selected_->name, texel, copy_.size().y,
                            describe(value, copy_.format().is_float, how_.is_display));
    if (how_.depth == 2 && value.value[0] < 1) {
        char words[48];
        std::snprintf(words, sizeof words, "   distance %.4g x near", 1 / (1 - double(value.value[0])));
        text += words;
    }
    return text;
}

void Inspector::drawStrip(const Rectangle& place, float pixels_per_unit, const std::vector<PassTime>& times,
                          const std::string& probed) {
    const float em = ImGui::GetFontSize();
    nextWindowAt(place, pixels_per_unit);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.4F * em, 0.25F * em});
    ImGui::Begin("##strip", nullptr,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoScrollbar |
                     ImGuiWindowFlags_NoBringToFrontOnFocus);
    Ui::pushMono();
    ImGui::TextUnformatted(probed.empty() ? "point at a pixel to read it" : probed.c_str());
    Ui::popFont();
    ImGui::BeginChild("##targets", {0, 0}, false, ImGuiWindowFlags_HorizontalScrollbar);
    const ImVec2 size(static_cast<float>(thumbnail_px_.x) / pixels_per_unit,
                      static_cast<float>(thumbnail_px_.y) / pixels_per_unit);
    const auto rows = static_cast<float>(std::max<std::size_t>(thumbnails_.size(), 1));
    std::optional<PassTarget> clicked;
    for (std::size_t i = 0; i < thumbnails_.size(); ++i) {
        const Thumbnail& one = thumbnails_[i];
        if (i > 0) ImGui::SameLine();
        ImGui::PushID(static_cast<int>(i));
        const ImVec2 at = ImGui::GetCursorScreenPos();
        if (ImGui::InvisibleButton("##look", {size.x, size.y + 2.2F * em})) clicked = one.target;
        const bool is_lit = ImGui::IsItemHovered() || ImGui::IsItemFocused();
        const bool is_selected = selected_ == one.target;
        ImDrawList& list = *ImGui::GetWindowDrawList();
        const ImVec2 end(at.x + size.x, at.y + size.y);
        const auto row = static_cast<float>(i);
        list.AddImage(imageOf(atlas_.color()), at, end, {0, (row + 1) / rows}, {1, row / rows});
        if (is_lit || is_selected)
            list.AddRect(at, end, ImGui::GetColorU32(is_selected ? ImGuiCol_CheckMark : ImGuiCol_Text), 0, 0,
                         0.12F * em);
        const auto time = std::find_if(times.begin(), times.end(),
                                       [&](const PassTime& pass) { return pass.name == one.target.pass; });
        std::string words = "after " + one.target.pass + "\n" + one.what;
        if (time != times.end()) {
            char ms[32];
            std::snprintf(ms, sizeof ms, "\n%.3f ms", time->time_ms);
            words += ms;
        }
        tooltip(words);
        // Two lines under it, no wider than it is.
        const ImU32 bright = ImGui::GetColorU32(ImGuiCol_Text);
        const ImU32 faint = ImGui::GetColorU32(ImGuiCol_TextDisabled);
        const ImVec4 clip(at.x, at.y, end.x, end.y + 3 * em);
        std::string name = one.target.name;
        if (time != times.end()) {
            char ms[32];
            std::snprintf(ms, sizeof ms, "  %.2f ms", time->time_ms);
            name += ms;
        }
        ImFont* font = ImGui::GetFont();
        const float font_size = ImGui::GetFontSize();
        const ImVec2 below(at.x, end.y + 0.15F * em);
        list.AddText(font, font_size, below, bright, name.c_str(), nullptr, 0, &clip);
        list.AddText(font, font_size, {below.x, below.y + font_size}, faint, one.what.c_str(), nullptr, 0,
                     &clip);
        ImGui::PopID();
    }
    ImGui::EndChild();
    ImGui::End();
    ImGui::PopStyleVar();
    if (clicked) select(selected_ == clicked ? std::nullopt : clicked);
}

} // namespace gll
