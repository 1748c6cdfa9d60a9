// Lookup of asset = "multiple_scattering" with any content but "moments", in 1/sr: multiply it by the
// scattering coefficient alone. Use a clamped, bilinear sampler.
//
// D is the thickness of the air, h the altitude, both in km; sun_mu is the cosine of the sun's zenith
// angle. `twilight` is true with mapping = "twilight" and false with "hillaire". `crop` are the numbers
// `first` and `share` of a table whose sun axis [scene] has cropped, else (0, 1).
vec3 multiple_scattering(sampler2D table, float D, float h, float sun_mu, bool twilight, vec2 crop) {
    float x = 0.5 + 0.5 * (twilight ? sign(sun_mu) * sqrt(abs(sun_mu)) : sun_mu);
    vec2 size = vec2(textureSize(table, 0)), place = vec2((x - crop.x) / crop.y, h / D);
    return texture(table, (0.5 + place * (size - 1.0)) / size).rgb;
}
