// Layouts of the G-buffer, drawing into it, and what readers of it need.
#include "gbuffer.hpp"

#include <glm/gtc/matrix_access.hpp>

namespace gll::gbuffer {

// excerpt: settings
GBufferOptions::GBufferOptions(Settings& settings)
    : packing(settings.choice(
          "packing", "separate", {"separate", "rgba16"},
          "a target for each of normals, albedo and the like; or all but the position in the 64 "
          "bits of one")),
      normals(settings.choice(
          "normals", "rgba16f", {"rgba32f", "rgba16f", "rgb10", "rgb8", "oct16", "oct12", "oct10", "oct8"},
          "what holds normals: x, y and z in a format; or two octahedral numbers of so many bits")),
      precise(settings.toggle("precise", false,
                              "of the four octahedral codes round a normal, store the nearest")),
      positions(settings.choice("positions", "rgba16f",
                                {"rgba32f", "rgba16f", "linear", "depth32f", "depth24", "depth16"},
                                "what tells positions: x, y and z; view z as a 32-bit float; or the depth "
                                "buffer alone")),
      gloss(settings.choice("gloss", "float", {"float", "8", "6", "4", "palette"},
                            "what holds the exponent of highlights: a float; its logarithm in bits; or which "
                            "of two materials it is")),
      albedo(settings.choice("albedo", "linear", {"float", "linear", "srgb", "root10"},
                             "how albedo is stored: 32-bit floats; 8 bits, which have bands in the dark; 8 "
                             "bits of sRGB; 10 bits of its square root, and the specular intensity apart")),
      geometric(
          settings.toggle("geometric", false,
                          "store the normal of the surface without its normal map too, 4 bytes; else it is "
                          "found from positions side by side")) {
    settings.shared("06_gbuffer",
                    {"packing", "normals", "precise", "positions", "gloss", "albedo", "geometric"});
    settings.needs({"normals", "gloss", "albedo"}, {{"packing", {"separate"}}});
    settings.needs({"precise"}, {{"normals", {"oct16", "oct12", "oct10", "oct8"}}});
}
// end excerpt

// excerpt: gloss_place
// Where a channel is left over that can hold it, it costs nothing.
GlossPlace GBufferOptions::glossPlace() const {
    if (packing == "rgba16") return GlossPlace::packed;
    const bool in_bits = !(gloss == "float") && !(gloss == "palette");
    if (gloss == "palette") return GlossPlace::with_specular; // one bit of the specular intensity's eight
    if (normals == "rgba32f" || normals == "rgba16f") return GlossPlace::normal_alpha;
    if (in_bits && (normals == "rgb8" || normals == "oct12")) return GlossPlace::normal_alpha;
    if (in_bits && normals == "oct10") return GlossPlace::normal_blue;
    if (storesPosition()) return GlossPlace::position_alpha;
    if (gloss == "4") return GlossPlace::with_specular; // four bits of the eight
    return GlossPlace::target;
}
// end excerpt

// excerpt: layout
std::vector<Attachment> GBufferOptions::attachments() const {
    const auto format = [](const Choice& choice,
                           std::initializer_list<std::pair<const char*, Format>> formats) {
        for (const auto& [name, value] : formats)
            if (choice == name) return value;
        return formatNamed(choice.name());
    };
    std::vector<Attachment> attachments;
    if (packing == "rgba16")
        attachments = {{.name = "packed", .format = Format::rgba16}};
    else
        attachments = {
            {.name = "albedo",
             .format = format(albedo, {{"float", Format::rgba32f},
                                       {"linear", Format::rgba8},
                                       {"srgb", Format::srgb8_alpha8},
                                       {"root10", Format::rgb10_a2}})},
            {.name = "normal",
             .format = format(normals, {{"rgb10", Format::rgb10_a2},
                                        {"rgb8", Format::rgba8},
                                        {"oct16", Format::rg16},
                                        {"oct12", Format::rgba8}, // three bytes hold both, see gbuffer.glsl
                                        {"oct10", Format::rgb10_a2},
                                        {"oct8", Format::rg8}})}};
    if (storesSpecular()) attachments.push_back({.name = "specular", .format = Format::r8});
    if (storesPosition())
        attachments.push_back({.name = "position", .format = formatNamed(positions.name())});
    if (positions == "linear") attachments.push_back({.name = "view_z", .format = Format::r32f});
    if (glossPlace() == GlossPlace::target)
        attachments.push_back({.name = "gloss", .format = gloss == "float" ? Format::r16f : Format::r8});
    if (geometric) attachments.push_back({.name = "geometric", .format = Format::rg16});
    attachments.push_back(
        {.name = "depth",
         .format = positions.name().starts_with("depth") ? formatNamed(positions.name()) : Format::depth24});
    for (Attachment& attachment : attachments)
        attachment.filter = Filter::nearest;
    return attachments;
}
// end excerpt

// Names in capitals, for #if.
std::string inCapitals(std::string name) {
    for (char& letter : name)
        if (letter >= 'a' && letter <= 'z') letter = static_cast<char>(letter - 'a' + 'A');
    return name;
}

Defines GBufferOptions::defines() const {
    Defines locations; // LOCATION_NORMAL and so on
    const std::vector<Attachment> targets = attachments();
    for (std::size_t i = 0; i + 1 < targets.size(); ++i) // depth is the last
        locations.push_back({"LOCATION_" + inCapitals(targets[i].name), std::to_string(i)});
    const Defines places = {{"GLOSS_IN_NORMAL_ALPHA", "0"},
                            {"GLOSS_IN_NORMAL_BLUE", "1"},
                            {"GLOSS_IN_POSITION_ALPHA", "2"},
                            {"GLOSS_WITH_SPECULAR", "3"},
                            {"GLOSS_IN_TARGET", "4"},
                            {"GLOSS_IN_PACKED", "5"},
                            {"GLOSS_IN", std::to_string(static_cast<int>(glossPlace()))}};
    return packing.defines() + normals.defines() + positions.defines() + gloss.defines() + places +
           locations +
           Defines{{"PRECISE", precise ? "1" : "0"},
                   {"STORES_GEOMETRIC", geometric ? "1" : "0"},
                   {"STORES_SPECULAR", storesSpecular() ? "1" : "0"}};
}

std::vector<Draw> withPrograms(ShaderLibrary& shaders, std::vector<Draw> draws, const std::string& stages,
                               const Defines& defines) {
    for (Draw& draw : draws)
        draw.program = &shaders.program(stages + ".vert", stages + ".frag", defines + draw.part.defines);
    return draws;
}

// excerpt: geometry
void GBuffer::draw(Frame& frame, const std::string& pass, const View& view, const std::vector<Draw>& draws,
                   const Defines& material, const GBufferOptions& options) {
    target_.remake(options.attachments(), frame.size());
    const std::vector<Draw> ready =
        withPrograms(shaders_, draws, "06_gbuffer/geometry", options.defines() + material);
    frame.pass(pass, target_,
               {.program = *ready.front().program,
                .uniforms = {{"clip_from_world", view.clip_from_view * view.view_from_world}},
                .part = {.uniforms = {{"view_z_from_world", glm::row(view.view_from_world, 2)}}},
                .draws = ready,
                .depth_test = DepthTest::less,
                .srgb_encode = options.albedo == "srgb",
                .clear_color = glm::vec4(0),
                .clear_depth = 1.0F});
}
// end excerpt

glm::vec2 viewZFromDepth(const glm::mat4& clip_from_view) {
    return {-0.5F * clip_from_view[3][2], 0.5F * (clip_from_view[2][2] - 1)};
}

ShaderPart GBuffer::part(const View& view, const GBufferOptions& options) const {
    const glm::mat3 world_from_view = glm::transpose(glm::mat3(view.view_from_world));
    const glm::vec2 scale(view.clip_from_view[0][0], view.clip_from_view[1][1]);
    ShaderPart part = {
        .defines = options.defines(),
        .uniforms = {{"camera_position", view.camera_position},
                     {"view_z_from_depth", viewZFromDepth(view.clip_from_view)},
                     {"world_from_ray", glm::mat3(world_from_view[0] / scale.x, world_from_view[1] / scale.y,
                                                  -world_from_view[2])},
                     {"view_from_world", view.view_from_world},
                     {"view_from_ndc", 1.0F / scale},
                     {"material_shininess", palette_shininess}}};
    for (const Attachment& attachment : target_.attachments())
        part.inputs.push_back({attachment.name + "_map", target_[attachment.name]});
    return part;
}

} // namespace gll::gbuffer
