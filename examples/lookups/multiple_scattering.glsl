// Lookup of asset = "multiple_scattering" with any content but "moments", in 1/sr: multiply it by the
// scattering coefficient alone. Use a clamped, bilinear sampler.
//
// D is the thickness of the air, h the altitude, both in km; sun_mu is the cosine of the sun's zenith
// angle. `twilight` is true with mapping = "twilight" and false with "hillaire". `crop` are the numbers
// `first` and `share` of a table whose sun axis [scene] has cropped, else (0, 1). `size` are the texels.
// Cost: fetches 1, operations 12, divisions 0, special functions 1
vec4 multiple_scattering_of_4(sampler2D table, vec2 size, float D, float h, float sun_mu, bool twilight,
                              vec2 crop) {                        // of four wavelengths
    float x = 0.5 + 0.5 * (twilight ? sign(sun_mu) * sqrt(abs(sun_mu)) : sun_mu);
    return texture(table, vec2((x - crop.x) / crop.y, h / D) * (1.0 - 1.0 / size) + 0.5 / size);
}

vec3 multiple_scattering(sampler2D table, vec2 size, float D, float h, float sun_mu, bool twilight, vec2 crop) {
    return vec3(multiple_scattering_of_4(table, size, D, h, sun_mu, twilight, crop));
}
