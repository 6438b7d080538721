// Binding everything one pass needs, drawing it, and counting its bytes.
#include "gl/pass.hpp"

#include <algorithm>
#include <set>
#include <stdexcept>

namespace gll {
namespace {

void enable(GLenum capability, bool on) { on ? glEnable(capability) : glDisable(capability); }

void setState(const Framebuffer& target, const Pass& pass) {
    glBindFramebuffer(GL_FRAMEBUFFER, target.id());
    const Viewport view = pass.viewport.value_or(Viewport{{0, 0}, target.size()});
    glViewport(view.corner.x, view.corner.y, view.size.x, view.size.y);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    enable(GL_SCISSOR_TEST, false);
    enable(GL_STENCIL_TEST, false);
    enable(GL_MULTISAMPLE, false);
    enable(GL_FRAMEBUFFER_SRGB, pass.srgb_encode);
    enable(GL_DEPTH_TEST, pass.depth_test != DepthTest::off);
    glDepthMask(GL_TRUE);
    glDepthFunc(pass.depth_test == DepthTest::less_equal ? GL_LEQUAL : GL_LESS);
    enable(GL_CULL_FACE, pass.cull != Cull::none);
    glCullFace(pass.cull == Cull::front ? GL_FRONT : GL_BACK);
    enable(GL_DEPTH_CLAMP, pass.depth_clamp);
    glFrontFace(GL_CCW);
    enable(GL_BLEND, pass.blend != Blend::replace);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFunc(GL_ONE, GL_ONE);
    enable(GL_POLYGON_OFFSET_FILL, pass.polygon_offset.has_value());
    if (pass.polygon_offset) glPolygonOffset(pass.polygon_offset->x, pass.polygon_offset->y);
}

// Clears after the state is set: masks apply to clears, and the sRGB switch too.
void clear(const Framebuffer& target, const Pass& pass) {
    if (pass.clear_color)
        for (int i = 0; i < target.colorCount(); ++i)
            glClearBufferfv(GL_COLOR, i, &pass.clear_color->x);
    if (pass.clear_depth) glClearBufferfv(GL_DEPTH, 0, &*pass.clear_depth);
}

bool uses(const Program& program, const std::string& uniform) { return program.uniforms().contains(uniform); }

// Sets inputs and uniforms of a program and remembers which were given.
class Bindings {
  public:
    explicit Bindings(const Program& program) : program_(program) { glUseProgram(program.id()); }
    ~Bindings() {
        for (std::size_t unit = 0; unit < units_.size(); ++unit) {
            glActiveTexture(static_cast<GLenum>(GL_TEXTURE0 + unit));
            glBindTexture(GL_TEXTURE_2D, 0);
            glBindTexture(GL_TEXTURE_CUBE_MAP, 0);
        }
        glActiveTexture(GL_TEXTURE0);
        glUseProgram(0);
    }
    Bindings(const Bindings&) = delete;
    Bindings& operator=(const Bindings&) = delete;

    // A pass or a draw: all that it names itself, and what the program uses of its part.
    template <class PassOrDraw>
    void set(const PassOrDraw& from) {
        for (const Input& input : from.part.inputs)
            if (uses(program_, input.sampler)) set(input);
        for (const UniformSetting& uniform : from.part.uniforms)
            if (uses(program_, uniform.name)) set(shortened(uniform));
        for (const Input& input : from.inputs)
            set(input);
        for (const UniformSetting& uniform : from.uniforms)
            set(uniform);
    }

    void requireAll() const {
        for (const auto& [name, uniform] : program_.uniforms())
            if (!given_.contains(name))
                throw std::invalid_argument(program_.name() + ": uniform " + name +
                                            " was not set: give it a value where the pass is drawn");
    }

  private:
    void set(const Input& input) {
        const int unit = static_cast<int>(units_.try_emplace(input.sampler, units_.size()).first->second);
        glActiveTexture(static_cast<GLenum>(GL_TEXTURE0 + unit));
        glBindTexture(input.texture->target(), input.texture->id());
        program_.set(input.sampler, unit);
        given_.insert(input.sampler);
    }
    // A part's list without the elements at its end that this variant does not use, which the compiler has
    // removed.
    UniformSetting shortened(UniformSetting uniform) const {
        const auto most = static_cast<std::size_t>(program_.uniforms().find(uniform.name)->second.count);
        std::visit(
            [&](auto& value) {
                if constexpr (requires { value.resize(most); })
                    if (value.size() > most) value.resize(most);
            },
            uniform.value);
        return uniform;
    }
    void set(const UniformSetting& uniform) {
        program_.set(uniform.name, uniform.value);
        given_.insert(uniform.name);
    }

    const Program& program_;
    std::map<std::string, std::size_t> units_;
    std::set<std::string> given_;
};

void drawAll(const Pass& pass, const Mesh& full_screen_triangle) {
    if (pass.draws.empty()) {
        Bindings bindings(pass.program);
        bindings.set(pass);
        bindings.requireAll();
        (pass.mesh != nullptr ? *pass.mesh : full_screen_triangle).draw(pass.instances);
    }
    for (const Draw& draw : pass.draws) { // each from the pass's own values: no draw sees another's
        Bindings bindings(draw.program != nullptr ? *draw.program : pass.program);
        bindings.set(pass);
        bindings.set(draw);
        bindings.requireAll();
        draw.mesh.draw(1, draw.first_index, draw.index_count);
    }
}

// What is bound around a pass, unbound also where the pass throws.
class Scope {
  public:
    explicit Scope(const std::string& name) {
        if (GLAD_GL_KHR_debug) glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, -1, name.c_str());
    }
    ~Scope() {
        glBindFramebuffer(GL_FRAMEBUFFER, 0);
        if (GLAD_GL_KHR_debug) glPopDebugGroup();
    }
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;
};

} // namespace

ShaderPart& ShaderPart::operator+=(const ShaderPart& other) {
    defines.insert(defines.end(), other.defines.begin(), other.defines.end());
    inputs.insert(inputs.end(), other.inputs.begin(), other.inputs.end());
    uniforms.insert(uniforms.end(), other.uniforms.begin(), other.uniforms.end());
    return *this;
}

ShaderPart operator+(ShaderPart one, const ShaderPart& other) { return one += other; }

void drawPass(const std::string& name, const Framebuffer& target, const Pass& pass,
              const Mesh& full_screen_triangle) {
    const Scope scope(name);
    setState(target, pass);
    clear(target, pass);
    drawAll(pass, full_screen_triangle);
    if (!pass.generate_mipmaps) return;
    for (std::size_t i = 0; i < target.attachments().size(); ++i)
        if (target.attachments()[i].mipmapped) target.texture(i).generateMipmaps();
}

double bytesPerPixel(const Framebuffer& target, const Pass& pass) {
    const auto area = [](glm::ivec2 size) { return double(size.x) * double(size.y); };
    double bytes = 0;
    for (const Attachment& attachment : target.attachments()) {
        const FormatInfo info = formatInfo(attachment.format);
        const bool touched = !info.is_depth || pass.depth_test != DepthTest::off;
        const bool also_read = info.is_depth || pass.blend != Blend::replace;
        if (touched) bytes += info.bytes * (also_read ? 2 : 1);
    }
    std::set<GLuint> counted;
    const auto add = [&](const Input& input) {
        if (counted.insert(input.texture->id()).second)
            bytes += formatInfo(input.texture->format()).bytes * area(input.texture->size()) *
                     input.texture->sides() / area(target.size());
    };
    const auto addUsed = [&](const ShaderPart& part, const Program& program) {
        for (const Input& input : part.inputs)
            if (uses(program, input.sampler)) add(input);
    };
    std::for_each(pass.inputs.begin(), pass.inputs.end(), add);
    if (pass.draws.empty()) addUsed(pass.part, pass.program);
    for (const Draw& draw : pass.draws) {
        const Program& program = draw.program != nullptr ? *draw.program : pass.program;
        addUsed(pass.part, program);
        addUsed(draw.part, program);
        std::for_each(draw.inputs.begin(), draw.inputs.end(), add);
    }
    return bytes;
}

} // namespace gll
