// The key: how bright a scene of this average luminance should come out.

// excerpt: key
// Krawczyk et al. 2005, "Perceptual Effects in Real-Time Tone Mapping": dark scenes stay dark, bright ones
// bright. 0.03 for black, towards 1.03 for endless light; log10(x) = log2(x) * log10(2).
float keyOf(float average_luminance) {
    return 1.03 - 2.0 / (2.0 + log2(average_luminance + 1.0) * 0.30103);
}
// end excerpt
