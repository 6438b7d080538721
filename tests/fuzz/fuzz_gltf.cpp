// Fuzzes the glTF reader, text and binary. A buffer b.bin and a texture t.png lie beside the input; whatever
// image the file embeds is decoded too.
#include "check_mesh.hpp"
#include "fuzz_files.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace gll;
    static const std::filesystem::path texture = fuzz::write("t.png", "x");
    static const std::filesystem::path buffer = fuzz::write("b.bin", std::string(256, '\0'));
    const auto file = fuzz::write("a.glb", std::string_view(reinterpret_cast<const char*>(data), size));
    fuzz::mayOnlyRefuse([&] {
        const MeshData mesh = loadMesh(file);
        fuzz::checkMesh(mesh);
        for (const MaterialData& material : mesh.materials)
            if (!material.base_color_texture.image.empty()) loadImage(material.base_color_texture.image);
    });
    return 0;
}
