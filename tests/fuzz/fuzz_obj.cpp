// Fuzzes the OBJ and MTL readers: an input is an OBJ, and after a line "===", its MTL.
// A texture t.png lies beside them, so that texture statements can succeed.
#include "check_mesh.hpp"
#include "fuzz_files.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace gll;
    static const std::filesystem::path texture = fuzz::write("t.png", "x");
    const std::string_view input(reinterpret_cast<const char*>(data), size);
    constexpr std::string_view border = "===\n";
    const std::size_t at = input.find(border);
    const auto library = fuzz::write(
        "a.mtl", at == std::string_view::npos ? std::string_view() : input.substr(at + border.size()));
    const auto mesh = fuzz::write("a.obj", input.substr(0, at));
    std::vector<std::string> warnings;
    fuzz::mayOnlyRefuse([&] { loadMtl(library, warnings); });
    fuzz::mayOnlyRefuse([&] { fuzz::checkMesh(loadMesh(mesh)); });
    return 0;
}
