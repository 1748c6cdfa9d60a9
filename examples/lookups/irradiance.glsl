// Lookup of asset = "irradiance": what falls on a level surface that faces up, for a solar irradiance
// of 1. Use a clamped, bilinear sampler. Times albedo / pi it is the radiance of the ground. Light of the sky
// alone, for instance to light a cloud, needs content = "sky", as the default holds the sun's light too.
//
// D is the thickness of the air, h the altitude, both in km; sun_mu is the cosine of the sun's zenith
// angle. `twilight` is true with mapping = "twilight" and false with "hillaire". `size` are the table's
// texels.
// Cost: fetches 1, operations 10, divisions 0, special functions 2
vec4 irradiance_of_4(sampler2D table, vec2 size, float D, float h, float sun_mu, bool twilight) {    // wavelengths
    float x = 0.5 + 0.5 * (twilight ? sign(sun_mu) * sqrt(abs(sun_mu)) : sun_mu);
    return texture(table, vec2(x, sqrt(h / D)) * (1.0 - 1.0 / size) + 0.5 / size);
}

vec3 irradiance(sampler2D table, vec2 size, float D, float h, float sun_mu, bool twilight) {
    return vec3(irradiance_of_4(table, size, D, h, sun_mu, twilight));
}
