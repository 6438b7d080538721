// Reads MTL: materials as Wavefront has them, with the usual names for metallic and roughness. Not through
// tinyobjloader, which takes the file's name for the third number of "-s 2 2" and knows no lines.
#include "io/mesh_build.hpp"
#include "io/statements.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gll {
namespace {

// Numbers as "Kd r g b"; a single one stands for all three, as the MTL specification has it.
glm::vec3 parseColor(const Statement& s) {
    std::string_view rest = s.rest;
    glm::vec3 color(parseNumber(nextWord(rest), s));
    if (!rest.empty()) {
        color.y = parseNumber(nextWord(rest), s);
        color.z = parseNumber(nextWord(rest), s);
    }
    if (color.x < 0.0F || color.y < 0.0F || color.z < 0.0F)
        throw fileError(s.where(), "a color is not negative in any channel");
    return color;
}

float parseUnit(const Statement& s) {
    std::string_view rest = s.rest;
    const float value = parseNumber(nextWord(rest), s);
    if (value < 0.0F || value > 1.0F) throw fileError(s.where(), "a value of 0 to 1 is needed");
    return value;
}

// What "map_... [options] file" says.
struct MapStatement {
    std::string name;
    TextureData texture; // without its image
    float bump_scale = 1.0F;
};

MapStatement parseMap(const Statement& s) {
    // The most words that follow; of the numbers, -s 2 alone is enough.
    static const std::map<std::string_view, int> options = {
        {"-blendu", 1}, {"-blendv", 1}, {"-boost", 1},   {"-bm", 1},        {"-cc", 1},
        {"-clamp", 1},  {"-mm", 2},     {"-o", 3},       {"-s", 3},         {"-t", 3},
        {"-texres", 1}, {"-type", 1},   {"-imfchan", 1}, {"-colorspace", 1}};
    MapStatement map;
    glm::vec2 scale(1.0F);
    glm::vec2 offset(0.0F);
    std::string_view rest = s.rest;
    while (rest.starts_with('-')) {
        const std::string_view option = nextWord(rest);
        const auto known = options.find(option);
        if (known == options.end())
            throw fileError(s.where(), "the texture option " + inQuotes(option) + " is unknown, remove it");
        std::vector<float> numbers;
        std::string_view word;
        double unused = 0.0;
        for (int i = 0; i < known->second; ++i) {
            std::string_view ahead = rest;
            word = nextWord(ahead);
            const bool is_number = isNumber(word, unused);
            if (known->second > 1 && !is_number) break;
            if (is_number) numbers.push_back(parseNumber(word, s));
            rest = ahead;
        }
        const auto number = [&](std::size_t i, float otherwise) {
            return i < numbers.size() ? numbers[i] : otherwise;
        };
        if (option == "-bm") map.bump_scale = number(0, 1.0F);
        if (option == "-o") offset = {number(0, 0.0F), number(1, 0.0F)};
        if (option == "-s") scale = {number(0, 1.0F), number(1, 1.0F)};
        if (option == "-clamp" && word == "on")
            map.texture.wrap_u = map.texture.wrap_v = TextureWrap::clamp_to_edge;
        if (option == "-imfchan") {
            const std::size_t channel = std::string_view("rgbml").find(word);
            if (word.size() != 1 || channel == std::string_view::npos)
                throw fileError(s.where(), "-imfchan takes r, g, b or m");
            map.texture.channel = channel < 3 ? static_cast<int>(channel) : 0;
        }
        rest = trimmed(rest);
    }
    if (rest.empty()) throw fileError(s.where(), "the texture's file name is missing");
    map.name = rest;
    // uv * scale + offset with v up, as common readers take it; v runs down here.
    map.texture.uv_transform = glm::mat3x2(scale.x, 0.0F, 0.0F, scale.y, offset.x, 1.0F - scale.y - offset.y);
    return map;
}

class MtlReader {
  public:
    MtlReader(const std::filesystem::path& path, Notes& notes) : folder_(path.parent_path()), notes_(notes) {
        std::string text = readFile(path, max_mesh_file_bytes);
        forEachStatement(text, path.string(),
                         [&](const Statement& s) { notes_.attempt(s.where(), [&] { read(s); }); });
        finish();
        if (materials.empty()) throw fileError(path.string(), "has no material, add a newmtl statement");
    }

    std::vector<MaterialData> materials;

  private:
    void read(const Statement& s) {
        const std::string keyword = lowerCase(s.keyword);
        if (keyword == "newmtl") {
            finish();
            materials.emplace_back().name = s.rest;
            materials.back().base_color = glm::vec4(glm::vec3(plain_grey), 1.0F);
            return;
        }
        const bool is_map = keyword.starts_with("map_") || keyword == "bump" || keyword == "norm" ||
                            keyword == "disp" || keyword == "decal" || keyword == "refl";
        constexpr std::array numbers = {"kd", "ke", "pr", "pm", "d", "tr"};
        if (!is_map && std::find(numbers.begin(), numbers.end(), keyword) == numbers.end()) return;
        if (materials.empty())
            throw fileError(s.where(), inQuotes(s.keyword) + " comes before the first newmtl");
        MaterialData& material = materials.back();
        if (is_map) return readMap(s, keyword, material);
        if (keyword == "kd") {
            material.base_color = glm::vec4(parseColor(s), 1.0F);
            color_given_ = true;
        } else if (keyword == "ke") {
            material.emitted_color = parseColor(s);
        } else if (keyword == "pr") {
            material.roughness = parseUnit(s);
        } else if (keyword == "pm") {
            material.metallic = parseUnit(s);
            metallic_given_ = true;
        } else if (parseUnit(s) != (keyword == "d" ? 1.0F : 0.0F)) {
            throw fileError(s.where(), "an opacity below 1 is drawn as 1");
        }
    }

    void readMap(const Statement& s, const std::string& keyword, MaterialData& material) {
        MapStatement map = parseMap(s);
        if (keyword == "map_ka" || keyword == "map_d") { // see finish()
            (keyword == "map_d" ? opacity_ : ambient_) = Named{map.name, s.where()};
            return;
        }
        const auto load = [&](TextureData& texture) {
            map.texture.image.file = namedFile(map.name, "texture", folder_, s, notes_);
            map.texture.image.name = map.texture.image.file.string();
            if (map.texture.image.empty()) return false;
            texture = map.texture;
            return true;
        };
        if (keyword == "map_kd") {
            color_ = map.name;
            if (load(material.base_color_texture) && !color_given_) material.base_color = glm::vec4(1.0F);
        } else if (keyword == "map_ke") {
            if (load(material.emitted_color_texture) && material.emitted_color == glm::vec3(0.0F))
                material.emitted_color = glm::vec3(1.0F);
        } else if (keyword == "map_ao") {
            load(material.occlusion_texture);
        } else if (keyword == "map_pr") {
            load(material.roughness_texture);
        } else if (keyword == "map_pm") {
            if (load(material.metallic_texture) && !metallic_given_) material.metallic = 1.0F;
        } else if (keyword == "norm" || keyword == "map_kn") {
            load(material.normal_texture);
        } else if (keyword == "map_bump" || keyword == "bump") {
            if (load(material.height_texture)) material.height_scale = map.bump_scale;
        } else {
            throw fileError(s.where(), inQuotes(s.keyword) + " is not drawn");
        }
    }

    // What can only be told at a material's end.
    void finish() {
        // Exporters name the image of map_Kd again as the color in ambient light.
        if (!ambient_.name.empty() && ambient_.name != color_)
            notes_.add(ambient_.where, "'map_Ka' is not drawn; occlusion is 'map_ao'");
        if (!opacity_.name.empty() && opacity_.name == color_)
            materials.back().alpha_mode = AlphaMode::mask;
        else if (!opacity_.name.empty())
            notes_.add(opacity_.where, "'map_d' is not drawn where it is another image than map_Kd");
        ambient_ = opacity_ = {};
        color_.clear();
        color_given_ = metallic_given_ = false;
    }

    struct Named {
        std::string name, where;
    };

    std::filesystem::path folder_;
    Notes& notes_;
    Named ambient_, opacity_; // of the material being read, as are:
    std::string color_;
    bool color_given_ = false;
    bool metallic_given_ = false;
};

} // namespace

std::vector<MaterialData> readMtl(const std::filesystem::path& path, Notes& notes) {
    return MtlReader(path, notes).materials;
}

std::vector<MaterialData> loadMtl(const std::filesystem::path& path, std::vector<std::string>& warnings) {
    Notes notes;
    std::vector<MaterialData> materials = readMtl(path, notes);
    const std::vector<std::string> lines = notes.lines();
    warnings.insert(warnings.end(), lines.begin(), lines.end());
    return materials;
}

} // namespace gll
