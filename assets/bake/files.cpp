// Files through OpenImageIO, which stays inside this translation unit.
// Thread count is fixed at one inside the library: an encoder that splits its work could change the bytes.
#include "files.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <fstream>
#include <mutex>
#include <stdexcept>
#include <thread>

#include <OpenImageIO/imageio.h>

namespace bake {
namespace {

void write(const std::filesystem::path& path, OIIO::ImageSpec spec, OIIO::TypeDesc type, const void* values) {
    OIIO::attribute("threads", 1);
    const auto out = OIIO::ImageOutput::create(path.string());
    if (!out) throw std::runtime_error(path.string() + ": no encoder for it: " + OIIO::geterror());
    if (!out->open(path.string(), spec) || !out->write_image(type, values) || !out->close()) {
        throw std::runtime_error(path.string() + ": cannot write it: " + out->geterror());
    }
}

OIIO::ImageSpec specOf(const Picture& p) { return {p.width, p.height, p.channels, OIIO::TypeDesc::UINT8}; }

} // namespace

Picture::Picture(int width_px, int height_px, int channel_count)
    : width{width_px}, height{height_px}, channels{channel_count},
      values(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px) *
             static_cast<std::size_t>(channel_count)) {}

void Picture::set(int x, int y, const glm::dvec3& color) {
    for (int c = 0; c < channels; ++c) {
        const std::size_t index =
            (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) *
                static_cast<std::size_t>(channels) +
            static_cast<std::size_t>(c);
        values[index] = static_cast<std::uint8_t>(std::lround(std::clamp(color[c], 0.0, 1.0) * 255.0));
    }
}

void Picture::set(int x, int y, double grey) { set(x, y, glm::dvec3{grey}); }

double srgbEncode(double linear) {
    const double l = std::clamp(linear, 0.0, 1.0);
    return l <= 0.0031308 ? 12.92 * l : 1.055 * std::pow(l, 1.0 / 2.4) - 0.055;
}

glm::dvec3 srgbEncode(const glm::dvec3& linear) {
    return {srgbEncode(linear.r), srgbEncode(linear.g), srgbEncode(linear.b)};
}

glm::dvec3 normalColor(const glm::dvec3& normal) { return (normal * 127.0 + 128.0) / 255.0; }

void writeText(const std::filesystem::path& path, const std::string& text) {
    std::ofstream out{path, std::ios::binary};
    out << text;
    out.close();
    if (!out) throw std::runtime_error(path.string() + ": cannot write it; is the folder writable?");
}

void writePng(const std::filesystem::path& path, const Picture& picture) {
    OIIO::ImageSpec spec = specOf(picture);
    spec.attribute("png:compressionLevel", 9);
    write(path, spec, OIIO::TypeDesc::UINT8, picture.values.data());
}

void writeJpeg(const std::filesystem::path& path, const Picture& picture, int quality) {
    OIIO::ImageSpec spec = specOf(picture);
    spec.attribute("Compression", "jpeg:" + std::to_string(quality));
    write(path, spec, OIIO::TypeDesc::UINT8, picture.values.data());
}

void writeHdr(const std::filesystem::path& path, int width, int height, const std::vector<float>& rgb) {
    write(path, OIIO::ImageSpec{width, height, 3, OIIO::TypeDesc::FLOAT}, OIIO::TypeDesc::FLOAT, rgb.data());
}

void forEachRow(int rows, const std::function<void(int)>& row) {
    std::exception_ptr error;
    std::mutex error_mutex;
    const auto work = [&](int first) {
        try {
            for (int y = first; y < rows; y += 2)
                row(y);
        } catch (...) {
            const std::lock_guard lock{error_mutex};
            error = std::current_exception();
        }
    };
    {
        const std::jthread odd_rows{work, 1};
        work(0);
    }
    if (error) std::rethrow_exception(error);
}

} // namespace bake
