// What a rung is to the programs that run it: a name, settings, and frames rendered on demand.
#pragma once

#include "io/image.hpp"
#include "rung/context.hpp"
#include "rung/frame.hpp"
#include "rung/resources.hpp"
#include "rung/settings.hpp"
#include "rung/warnings.hpp"

#include <functional>
#include <memory>
#include <set>
#include <string_view>
#include <utility>

namespace gll {

// Files a person gives in place of the rung's own; empty: the rung's own.
struct RungFiles {
    std::filesystem::path mesh;        // --mesh
    std::filesystem::path floor;       // --floor
    std::filesystem::path environment; // --environment
    std::filesystem::path image;       // --image

    bool operator==(const RungFiles&) const = default;
};

// The options of the command line, and keys of a batch, that name them.
struct FileOption {
    std::string_view name; // "mesh"
    std::filesystem::path RungFiles::*file;
    const char* help;
};
inline constexpr FileOption file_options[] = {
    {"mesh", &RungFiles::mesh, "your own model: .obj, .gltf or .glb"},
    {"floor", &RungFiles::floor, "your own floor material: .mtl"},
    {"environment", &RungFiles::environment, "your own sky: .hdr or .exr"},
    {"image", &RungFiles::image, "your own picture instead of the scene: .exr, .hdr, .png, .jpg, .tga, .bmp"},
};

// What a rung is made from, once there is an OpenGL context.
struct RungResources {
    ShaderLibrary& shaders;
    const Resources& files;
    RungFiles given;
    Warnings& warnings; // what the given files hold and the rung does not draw; valid as long as the rung

    // The file that was given, or the rung's own of that name. Throws as Resources::find().
    std::filesystem::path file(std::filesystem::path RungFiles::*which, const char* own) const {
        return (given.*which).empty() ? files.find(own) : given.*which;
    }
};

// A number that a frame arrived at and that its picture only hints at, such as a metered luminance.
struct Reading {
    std::string name; // as a setting's: "adapted_luminance"
    std::string unit; // empty where it has none
    double value = 0;
    bool is_exposure = false; // in stops: what --budget ev= compares
};

class Rung {
  public:
    virtual ~Rung() = default;

    // Draws the frame, the last pass into frame.presented(). The picture depends on nothing but the settings,
    // the frame's size and its number.
    virtual void render(Frame& frame) = 0;

    // Of the frame rendered last, in the order to show them; may wait for it to be drawn. Most rungs have
    // none.
    virtual std::vector<Reading> readings() { return {}; }

    // KEY=VALUE of settings that now follow from a method and must not change with it: what a blur's width
    // is, say, where each method has its own. Set before methods are compared (--budget).
    virtual std::vector<std::string> implied() const { return {}; }
};

struct RungInfo {
    std::string name;                      // "05_hdr_bloom"
    std::string summary;                   // one line
    std::set<std::string_view> takes = {}; // which of file_options mean anything to it
    std::function<std::unique_ptr<Rung>(RungResources)> make = {};
};

// A rung in a context, ready to render. The context must stay current as long as the renderer lives.
class Renderer {
  public:
    // Warnings of the files that are read, here and in render(), go to stderr as "NN_name: warning: ...".
    Renderer(Context& context, const RungInfo& info, const RungFiles& given);

    // Renders frame number (from 1) at size (pixels, both at least 1) with the present settings. Throws
    // std::runtime_error on any OpenGL error. What it returns is valid until the next call.
    const std::vector<DrawnPass>& render(int number, glm::ivec2 size, PassObserver* observer = nullptr);

    // Of the frame rendered last.
    const std::vector<DrawnPass>& passes() const { return passes_; }

    // What the rung read in the frame rendered last.
    std::vector<Reading> readings() { return rung_->readings(); }

    std::vector<std::string> implied() const { return rung_->implied(); }

    // The warnings said since this was last asked, for a window to show.
    std::vector<std::string> takeWarnings() { return std::exchange(said_, {}); }

    const Framebuffer& presented() const { return presented_; }

    // Pixels of a target of the frame rendered last, and of the presented one, whose colours are
    // sRGB-encoded.
    Image image(const Texture& target) const;
    Image image() const { return image(presented_.color()); }

    const Mesh& fullScreenTriangle() const { return triangle_; }
    ShaderLibrary& shaders() { return shaders_; }
    Context& context() { return context_; }

  private:
    void sayWarnings();

    Context& context_;
    std::string name_; // of the rung
    Warnings warnings_;
    std::vector<std::string> said_;
    Resources resources_;
    ShaderLibrary shaders_;
    Mesh triangle_ = Mesh::fullScreenTriangle();
    Framebuffer presented_{{{.name = "frame", .format = Format::rgba8}}, {1, 1}};
    std::unique_ptr<Rung> rung_;
    std::vector<DrawnPass> passes_;
};

} // namespace gll
