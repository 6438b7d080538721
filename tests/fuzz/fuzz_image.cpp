// Fuzzes the image readers with whole files, told apart by their first bytes; what has none of a format's
// marks is a TGA by its name. A PNG's checksums are mended behind each mutation, or none would be looked
// into.
#include "fuzz_files.hpp"

#include "io/image.hpp"
#include "png_maker.hpp"

#include <algorithm>
#include <variant>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned) {
    using gll::test::pngChunk;
    size = LLVMFuzzerMutate(data, size, max_size);
    const std::string bytes(reinterpret_cast<const char*>(data), size);
    if (!bytes.starts_with("\x89PNG")) return size;
    for (std::size_t at = 8; at + 12 <= size;) {
        std::size_t length = 0;
        for (std::size_t i = 0; i < 4; ++i)
            length = length << 8 | data[at + i];
        if (length > size - at - 12) break;
        const std::string chunk = pngChunk(bytes.substr(at + 4, 4), bytes.substr(at + 8, length));
        std::copy(chunk.begin(), chunk.end(), data + at);
        at += 12 + length;
    }
    return size;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace gll;
    const auto file = fuzz::write("a.tga", std::string_view(reinterpret_cast<const char*>(data), size));
    fuzz::mayOnlyRefuse([&] {
        const Image image = loadImage(file);
        const std::size_t samples =
            std::visit([](const auto& pixels) { return pixels.size(); }, image.pixels);
        if (samples != static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) *
                           static_cast<std::size_t>(image.channels))
            std::abort();
        for (const std::string& warning : image.warnings)
            if (!warning.starts_with(file.string()) || warning.find('\n') != std::string::npos) std::abort();
    });
    return 0;
}
