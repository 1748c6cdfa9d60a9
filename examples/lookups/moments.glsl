// Lookup of asset = "multiple_scattering" with content = "moments": `tables` below each other, six with
// degree = 2. Use a clamped, bilinear sampler. D, h, sun_mu, twilight and crop are those of
// multiple_scattering.glsl; `size` are the texels of one table.

// The place in table 0, which is the uppermost.
vec2 moment_place(vec2 size, float D, float h, float sun_mu, bool twilight, vec2 crop) {
    float x = 0.5 + 0.5 * (twilight ? sign(sun_mu) * sqrt(abs(sun_mu)) : sun_mu);
    vec2 place = clamp(vec2((x - crop.x) / crop.y, h / D), 0.0, 1.0);      // beyond is the next table
    return place * (1.0 - 1.0 / size) + 0.5 / size;
}

// Cost with moment_place: fetches 1, operations 19, divisions 0, special functions 1
vec4 moment_of_4(sampler2D table, vec2 place, float tables, float j) {            // of four wavelengths
    return texture(table, vec2(place.x, (j + place.y) / tables));
}
vec3 moment(sampler2D table, vec2 place, float tables, float j) {
    return vec3(moment_of_4(table, place, tables, j));
}

// mu is the cosine of the view's zenith angle at the point, c the cosine of its azimuth from the sun
// there. chi are the layer's Legendre moments of degree 0 to 2, as far as these tables go: (1, 0, 0.1) for
// Rayleigh scattering, (1, 0.8436, 0.7097) for Cornette-Shanks with g = 0.8. The result, in 1/sr, is to
// be multiplied by the layer's scattering coefficient; its phase function is in it.
vec4 scattered_again_of_4(sampler2D table, vec2 place, float tables, float mu, float c, vec3 chi) {
    float s = sqrt(max(1.0 - mu * mu, 0.0));
    vec4 first = mu * moment_of_4(table, place, tables, 1.0)
               + s * c * moment_of_4(table, place, tables, 2.0);
    vec4 second = (1.5 * mu * mu - 0.5) * moment_of_4(table, place, tables, 3.0)
                + 3.0 * mu * s * c * moment_of_4(table, place, tables, 4.0)
                + 3.0 * s * s * (2.0 * c * c - 1.0) * moment_of_4(table, place, tables, 5.0);
    return chi.x * moment_of_4(table, place, tables, 0.0) + chi.y * first + chi.z * second;
}
vec3 scattered_again(sampler2D table, vec2 place, float tables, float mu, float c, vec3 chi) {
    return vec3(scattered_again_of_4(table, place, tables, mu, c, chi));
}
