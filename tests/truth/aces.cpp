// Two built-in transforms of OpenColorIO between matrices of our own: BT.709 to XYZ before, XYZ to BT.709
// after.
#include "truth/aces.hpp"

#include "measure/color.hpp"

#include <OpenColorIO/OpenColorIO.h>

#include <cmath>
#include <glm/common.hpp>
#include <stdexcept>
#include <string>

namespace gll::truth {
namespace {

namespace ocio = OCIO_NAMESPACE;

constexpr double brightest_aces = 65504; // ACES colours are half floats (SMPTE ST 2065-1)

ocio::BuiltinTransformRcPtr builtin(const char* style, ocio::TransformDirection direction) {
    const ocio::BuiltinTransformRcPtr transform = ocio::BuiltinTransform::Create();
    transform->setStyle(style);
    transform->setDirection(direction);
    return transform;
}

// From XYZ (D65, white has Y = 1) as the scene has it to XYZ as the display shows it.
ocio::ConstCPUProcessorRcPtr acesRendering() {
    const ocio::GroupTransformRcPtr group = ocio::GroupTransform::Create();
    group->appendTransform(builtin("UTILITY - ACES-AP0_to_CIE-XYZ-D65_BFD", ocio::TRANSFORM_DIR_INVERSE));
    group->appendTransform(
        builtin("ACES-OUTPUT - ACES2065-1_to_CIE-XYZ-D65 - SDR-VIDEO_1.0", ocio::TRANSFORM_DIR_FORWARD));
    return ocio::Config::CreateRaw()->getProcessor(group)->getOptimizedCPUProcessor(
        ocio::OPTIMIZATION_LOSSLESS);
}

} // namespace

std::vector<glm::dvec3> acesDisplayLight(const std::vector<glm::dvec3>& linear_colors) {
    try {
        const ocio::ConstCPUProcessorRcPtr rendering = acesRendering();
        std::vector<glm::dvec3> result;
        result.reserve(linear_colors.size());
        for (const glm::dvec3& color : linear_colors) {
            if (!(std::isfinite(color.r) && std::isfinite(color.g) && std::isfinite(color.b)))
                throw std::invalid_argument("acesDisplayLight: colour " + std::to_string(result.size()) +
                                            " is not finite");
            const glm::vec3 scene_xyz(measure::xyzFromBt709() *
                                      glm::clamp(color, -brightest_aces, brightest_aces));
            float xyz[3] = {scene_xyz.x, scene_xyz.y, scene_xyz.z};
            rendering->applyRGB(xyz);
            result.push_back(
                glm::clamp(measure::bt709FromXyz() * glm::dvec3(xyz[0], xyz[1], xyz[2]), 0.0, 1.0));
        }
        return result;
    } catch (const ocio::Exception& error) {
        throw std::runtime_error(std::string("OpenColorIO: ") + error.what() +
                                 ", install version 2.1 or newer");
    }
}

} // namespace gll::truth
