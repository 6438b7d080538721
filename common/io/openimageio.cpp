// The library behind openimageio.hpp.
#include "io/openimageio.hpp"

#include "io/files.hpp"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

namespace gll {
namespace {

// Its complaints, some of several lines, as one line in brackets; nothing when there is none.
std::string inBrackets(const std::string& complaint) {
    return complaint.empty() ? "" : " (" + complaint.substr(0, complaint.find('\n')) + ")";
}

// It and OpenEXR would keep threads until the process ends, over which LeakSanitizer stumbles.
void useNoThreads() {
    OIIO::attribute("threads", 1);
    OIIO::attribute("exr_threads", -1);
}

class Input final : public EncodedImage {
  public:
    Input(const char* format, std::string& bytes, const std::string& name)
        : memory_(bytes.data(), bytes.size()), name_(name), input_(OIIO::ImageInput::create(format)) {
        if (!input_ || !input_->set_ioproxy(&memory_))
            throw fileError(name, "this OpenImageIO lacks the reader for it, install one that has it");
        OIIO::ImageSpec config;
        config.attribute("oiio:UnassociatedAlpha", 1);
        OIIO::ImageSpec first;
        if (!input_->open(name, first, config))
            throw fileError(name,
                            "does not decode, fetch or export it again" + inBrackets(input_->geterror()));
    }

    Part part(int part) override {
        const OIIO::ImageSpec spec = input_->spec(part, 0);
        return {.width = spec.width,
                .height = spec.height,
                .channels = spec.channelnames,
                .has_bytes = spec.format == OIIO::TypeDesc::UINT8,
                .is_deep = spec.deep};
    }
    std::vector<std::uint8_t> bytes(int part, int first_channel, int end_channel) override {
        return read<std::uint8_t>(part, first_channel, end_channel);
    }
    std::vector<float> floats(int part, int first_channel, int end_channel) override {
        return read<float>(part, first_channel, end_channel);
    }

  private:
    template <typename Sample>
    std::vector<Sample> read(int part, int first_channel, int end_channel) {
        const OIIO::ImageSpec size = input_->spec(part, 0);
        std::vector<Sample> samples(static_cast<std::size_t>(size.width) *
                                    static_cast<std::size_t>(size.height) *
                                    static_cast<std::size_t>(end_channel - first_channel));
        constexpr OIIO::TypeDesc sample_type(OIIO::BaseTypeFromC<Sample>::value);
        const bool whole =
            input_->read_image(part, 0, first_channel, end_channel, sample_type, samples.data());
        const std::string complaint = input_->geterror();
        if (!whole || !complaint.empty())
            throw fileError(name_, "does not decode whole, fetch or export it again" + inBrackets(complaint));
        return samples;
    }

    OIIO::Filesystem::IOMemReader memory_;
    const std::string name_;
    std::unique_ptr<OIIO::ImageInput> input_;
};

std::unique_ptr<EncodedImage> open(const char* format, std::string& bytes, const std::string& name) {
    useNoThreads();
    return std::make_unique<Input>(format, bytes, name);
}

std::vector<unsigned char> encode(const char* format, const Image& image, bool full_float,
                                  const std::string& name) {
    useNoThreads();
    const std::string_view is(format);
    OIIO::ImageSpec spec(image.width, image.height, image.channels,
                         is == "openexr" && !full_float ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::FLOAT);
    spec.attribute("oiio:UnassociatedAlpha", 1);
    if (is == "openexr") {
        spec.attribute("compression", "zip");
        // Without one OpenImageIO writes the time of day, and equal pixels would make unequal files.
        spec.attribute("DateTime", "1970:01:01 00:00:00");
    }
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(format);
    if (!output || !output->set_ioproxy(&memory))
        throw fileError(name, "this OpenImageIO lacks the writer for it, install one that has it");
    if (!output->open(name, spec) ||
        !output->write_image(OIIO::TypeDesc::FLOAT, std::get<std::vector<float>>(image.pixels).data()) ||
        !output->close())
        throw fileError(name, "cannot be encoded" + inBrackets(output->geterror()));
    return bytes;
}

} // namespace

extern "C" const OpenImageIo gll_openimageio;
const OpenImageIo gll_openimageio = {open, encode};

} // namespace gll
