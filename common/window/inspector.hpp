// The inspector: a strip of every target in the order that passes draw them, and one of them looked into.
#pragma once

#include "rung/rung.hpp"
#include "window/layout.hpp"
#include "window/pass_timer.hpp"
#include "window/target_copy.hpp"

#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace gll {

// One attachment as one pass left it.
struct PassTarget {
    std::string pass;
    std::string name; // of the attachment

    bool operator==(const PassTarget&) const = default;
};

class Inspector final : public PassObserver {
  public:
    // Around a frame that it observes, whose thumbnails it draws with the renderer's shaders. thumbnail_px:
    // the size of one.
    void begin(Renderer& renderer, glm::ivec2 thumbnail_px);
    void after(const DrawnPass& pass) override;
    void end();

    // Whether the next frame has to be rendered for it, though nothing else has changed.
    bool wantsFrame() const { return wants_frame_; }

    // Whether a target is looked into in place of the picture.
    bool isInspecting() const { return selected_.has_value(); }
    const std::optional<PassTarget>& selected() const { return selected_; }
    void select(std::optional<PassTarget> target);

    // What is looked into, drawn for a place in the window under the bar; looked() and lookedAt() say what is
    // to be shown there. cursor: in pixels of the window.
    void look(Renderer& renderer, const Rectangle& picture, glm::dvec2 cursor);
    const Framebuffer& looked() const { return looked_; }
    Rectangle lookedAt() const { return looked_.size() == view_.size ? view_ : Rectangle{}; }
    void drag(glm::dvec2 moved_px);
    void zoom(double steps, glm::dvec2 cursor); // about the cursor

    // What is under the cursor, in words; of the picture, where no target is looked into and the cursor is
    // over it (texels, from the lower left). Empty where it is over neither.
    // name: what the picture is called.
    std::string probe(const std::string& name, const Framebuffer& presented,
                      std::optional<glm::ivec2> picture_texel) const;

    // Above what is looked into: its name, and how it is shown.
    void drawBar(const Rectangle& picture, float pixels_per_unit, float em_px);
    // The strip: a click selects a target, another one the picture again. times: of the passes, where known.
    void drawStrip(const Rectangle& place, float pixels_per_unit, const std::vector<PassTime>& times,
                   const std::string& probed);

  private:
    struct Thumbnail {
        PassTarget target;
        std::string what; // "rgba16f, 640x480"
    };
    // How a texture is shown; see shaders/window/inspect.frag.
    struct View {
        glm::vec2 corner{0};
        float texels_per_pixel = 1;
        float exposure_ev = 0;
        int channel = -1;
        bool as_stops = false;
        bool is_display = false; // encoded already
        int depth = 0;
        glm::vec2 depth_range{1};
        int taps = 2; // in each direction, where many texels share a pixel
    };

    bool isSelected(const DrawnPass& pass, std::size_t attachment) const;
    void takeCopy(const DrawnPass& pass, std::size_t attachment);
    void drawInto(const Framebuffer& target, const Texture& source, const Viewport& viewport,
                  const View& view);
    void viewChoices();
    void fit();
    glm::dvec2 texelAt(glm::dvec2 cursor) const; // of the copy, from the lower left

    Renderer* renderer_ = nullptr; // of the frame that is observed, or looked into
    glm::ivec2 thumbnail_px_{1};
    Framebuffer atlas_{{{.name = "thumbnails", .format = Format::rgba8}}, {1, 1}}; // a column of them
    std::vector<Thumbnail> thumbnails_;                                            // of the last frame
    std::vector<Thumbnail> drawn_;                                                 // so far, of this one
    bool wants_frame_ = true;

    std::optional<PassTarget> selected_;
    bool is_found_ = false; // in the last frame
    TargetCopy copy_;
    int levels_ = 1;
    int level_ = 0;
    View how_;                   // what is looked into is shown
    std::string described_;      // "rgba16f, 640x480"
    bool is_perspective_ = true; // a depth that is looked into
    TargetCopy::Contents contents_;
    std::chrono::steady_clock::time_point counted_;

    Rectangle view_; // where it is shown
    int bar_px_ = 0;
    bool fits_ = true;
    double pixels_per_texel_ = 1;
    glm::dvec2 center_{0}; // texels
    glm::dvec2 cursor_{0};
    Framebuffer looked_{{{.name = "view", .format = Format::rgba8}}, {1, 1}};
};

} // namespace gll
