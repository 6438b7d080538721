// The night sky's light, and the haze that hides far houses in it.

const vec3 zenith_color = vec3(0.006, 0.012, 0.036);
const vec3 horizon_color = vec3(0.13, 0.085, 0.12); // the glow of the town

// By the sine of the height above the horizon.
vec3 skyColor(float height) { return mix(zenith_color, horizon_color, exp(-5.0 * abs(height))); }
