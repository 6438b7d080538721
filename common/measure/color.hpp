// Colours in double: transfer functions, CIE XYZ, CIELAB and ICtCp, and how far apart two colours are in
// them. "linear_color" is linear light with BT.709 primaries; 1 is the display's white.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>

namespace gll::measure {

// IEC 61966-2-1, from linear light to display values and back; both for [0, 1].
double srgbEncoded(double linear);
double srgbDecoded(double display);

// ITU-R BT.709: 0.2126 R + 0.7152 G + 0.0722 B.
double luminance709(const glm::dvec3& linear_color);

// From linear RGB to CIE 1931 XYZ with Y = 1 for white (D65, x = 0.3127, y = 0.3290), derived from the
// primaries of BT.709 and of BT.2020 (SMPTE RP 177).
const glm::dmat3& xyzFromBt709();
const glm::dmat3& bt709FromXyz();
const glm::dmat3& xyzFromBt2020();

// CIELAB (CIE 15) under D65: L* in [0, 100] for display colours, a*, b*.
glm::dvec3 cieLab(const glm::dvec3& linear_color);

// What linear 1.0 is shown at, where nothing else is said: the reference white of an SDR display.
inline constexpr double default_white_cd_m2 = 100;

// ICtCp with the PQ curve (ITU-R BT.2100, BT.709 carried over to BT.2020 first): I in [0, 1], Ct and Cp in
// [-0.5, 0.5]. Light below 0 after the change of primaries counts as 0: PQ has no value for it.
glm::dvec3 ictcp(const glm::dvec3& linear_color, double white_cd_m2 = default_white_cd_m2);

// CIEDE2000 of two CIELAB colours (CIE 142; Sharma, Wu, Dalal 2005), all parametric factors 1.
double deltaE2000(const glm::dvec3& lab, const glm::dvec3& other_lab);

// Delta E ITP of two ICtCp colours (ITU-R BT.2124): 1 is just visible to the most sensitive eye.
double deltaEItp(const glm::dvec3& itp, const glm::dvec3& other_itp);

// How two colours differ. Hues are angles in [0, 180] degrees, of a*, b* and of Ct / 2, Cp (the scaling of
// BT.2124, in which distances are even); nothing where either colour is grey and has none.
struct ColorDifference {
    double delta_e_itp = 0;
    double delta_e_2000 = 0;
    std::optional<double> ictcp_hue_deg;
    std::optional<double> lab_hue_deg;
    double ictcp_intensity = 0; // I of the first less I of the second
    double lab_lightness = 0;   // L* of the first less L* of the second
};
ColorDifference colorDifference(const glm::dvec3& linear_color, const glm::dvec3& other_linear_color,
                                double white_cd_m2 = default_white_cd_m2);

} // namespace gll::measure
