// From a render target to a picture file.
#pragma once

#include "io/image.hpp"
#include "rung/frame.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace gll {

// The pixels of level 0, top row first: 8-bit where the format is, else float; 1 to 4 channels as the format
// has.
Image readTexture(const Texture& texture);

// The image as a file of this extension holds it. .png: RGB (or grey) as a display shows it; linear colours
// are clamped to [0, 1] and sRGB-encoded, data is clamped, not-a-number becomes 0. .exr and .hdr: linear
// floats, sRGB colours decoded; .hdr has three channels.
Image forFile(const Image& image, const std::string& extension);

// Whether saveImage() can write a path by its extension: .png, .exr or .hdr.
bool isWritableImage(const std::filesystem::path& path);

// The target names of drawn passes, in the order they were first drawn to: the attachments' names.
std::vector<std::string> targetNames(const std::vector<DrawnPass>& passes);

// The attachment of that name; null where none of the passes has one.
const Texture* findTarget(const std::vector<DrawnPass>& passes, const std::string& name);

} // namespace gll
