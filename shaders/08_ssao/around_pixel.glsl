// Samples placed on the screen: what is seen there, as a point in view space.

// At most this part of the screen is searched to either side, however near the camera is.
const float max_uv_radius = 0.4;

// The radius on the screen, in uv.
vec2 uvRadiusAt(float view_z) {
    vec2 uv_radius = radius * half_uv_from_view / -view_z;
    return uv_radius * min(max_uv_radius / max(uv_radius.x, uv_radius.y), 1.0); // still a circle in the scene
}

// Where the middle of the pixel is that uv lies in: the position that depth gives for another place would lie beside
// the surface.
vec2 pixelCenter(vec2 uv) { return (floor(uv * gbufferSize()) + 0.5) / gbufferSize(); }

bool isOnScreen(vec2 uv) { return uv == clamp(uv, 0.0, 1.0); }
