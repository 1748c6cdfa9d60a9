// The phase function of a layer that has a table, in the layer's row (live_phases). The table is read between two texels.
Light phase_in_row(sampler2D rows, int layer, vec3 ray, vec3 to_sun) {
    float x = phase_by_peaks(half_angle(ray, to_sun)) * float(textureSize(rows, 0).x - 1);
    int low = int(min(x, float(textureSize(rows, 0).x - 2)));
    return Light(mix(texelFetch(rows, ivec2(low, layer), 0), texelFetch(rows, ivec2(low + 1, layer), 0), x - float(low)));
}
