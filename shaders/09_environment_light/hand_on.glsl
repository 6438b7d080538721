// For the vertex stage of a program whose fragment stage includes environment.glsl with ENVIRONMENT_HANDED_ON: hands on
// what is the same in every pixel.
#include "09_environment_light/environment_terms.glsl"

#if HAS_SH
uniform vec3 irradiance_sh[9];
flat out vec3 flat_irradiance_sh[9];
#endif
#if HAS_BRIGHTEST
uniform vec3 to_brightest;
uniform vec3 brightest_irradiance;
flat out vec3 flat_to_brightest;
flat out vec3 flat_brightest_irradiance;
#endif

void handOnEnvironment() {
#if HAS_SH
    flat_irradiance_sh = irradiance_sh;
#endif
#if HAS_BRIGHTEST
    flat_to_brightest = to_brightest;
    flat_brightest_irradiance = brightest_irradiance;
#endif
}
