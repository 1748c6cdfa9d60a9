// Lookup of asset = "blue_noise": one value of a pixel and a frame. It fetches a texel, so that no sampler
// filters it. Pixel and frame may be any numbers, also below 0: the mask repeats. `size` are its texels.
// Cost: fetches 1, operations 21, divisions 0, special functions 0
vec4 blue_noise(sampler3D table, vec3 size, vec2 pixel, float frame) {
    vec3 at = vec3(floor(pixel.x), floor(pixel.y), floor(frame));
    return texelFetch(table, ivec3(at - size * floor((at + 0.5) / size)), 0);
}

// A value of unorm8 as one of 256 numbers that are spread evenly between 0 and 1, without both.
float blue_noise_between(float value) { return (255.0 * value + 0.5) / 256.0; }
