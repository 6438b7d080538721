// Whether a value may take part in an average. UNGUARDED lets everything in, to show what happens then.

// Nothing compares with not-a-number, so that this is false for it, as for the infinities.
bool isFinite(float x) {
#ifdef UNGUARDED
    return true;
#else
    return x > -3.0e38 && x < 3.0e38;
#endif
}
