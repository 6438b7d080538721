// How far a rung's ambient occlusion is off, and where.
#pragma once

#include "truth/occlusion_rays.hpp"

#include <cstddef>
#include <vector>

namespace gll::truth {

// A sum of squares and of signed errors over pixels.
class PixelErrors {
  public:
    void add(double error) {
        squares_ += error * error;
        sum_ += error;
        ++count_;
    }
    std::size_t count() const { return count_; }
    double rmse() const;
    double bias() const; // positive: too light

  private:
    double squares_ = 0, sum_ = 0;
    std::size_t count_ = 0;
};

// What is true of each pixel of a frame.
struct TrueOcclusion {
    int width = 0;
    std::vector<SeenPoint> points;
    std::vector<float> visibility; // by the triangles
    std::vector<float> on_screen;  // by the height field of what is seen
};

struct OcclusionErrors {
    PixelErrors all;       // against the triangles
    PixelErrors on_screen; // against the height field: what is the method's own fault
    PixelErrors flat;      // where nothing is near: rays find at least 99.5 % of the light
    PixelErrors creased;   // everywhere else
    PixelErrors dark;      // where less than half of the light arrives
    // Where the screen alone would say that something is in the way which is far in front: beside the edges
    // of what stands before a wall.
    PixelErrors halo;
    PixelErrors border; // within 8 pixels of the frame's edge
    PixelErrors noise;  // of 5 x 5 pixels of one plane, how far the middle one is from their mean
};

// visible: the frame's, [0, 1].
void addErrors(OcclusionErrors& errors, const TrueOcclusion& truth, const measure::ColorImage& visible);

} // namespace gll::truth
