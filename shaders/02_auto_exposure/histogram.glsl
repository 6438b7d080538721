// The histogram's scale: bins of equal width in stops.

const int bins = 128;
const float lowest_stop = -16.0; // log2 luminance; what lies beyond counts in the first or last bin
const float highest_stop = 16.0;

// In bins, from the lower edge of the first.
float binOf(float stops) { return (stops - lowest_stop) / (highest_stop - lowest_stop) * float(bins); }
