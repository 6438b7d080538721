// Fuzzes the image reader with Radiance HDR files, and with whatever else the mutations' first bytes select.
#include "fuzz_files.hpp"

#include "io/image.hpp"

#include <variant>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace gll;
    const auto file = fuzz::write("a.hdr", std::string_view(reinterpret_cast<const char*>(data), size));
    fuzz::mayOnlyRefuse([&] {
        const Image image = loadImage(file);
        const std::size_t samples =
            std::visit([](const auto& pixels) { return pixels.size(); }, image.pixels);
        if (samples != static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) *
                           static_cast<std::size_t>(image.channels))
            std::abort();
    });
    return 0;
}
