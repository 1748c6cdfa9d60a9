// The share of sunlight that passes each layer without being scattered, at POINTS x POINTS places below it. Layers
// follow each other along y.
out vec4 color;

const int POINTS = 32;

void main() {
    ivec2 texel = ivec2(gl_FragCoord.xy);
    int layer = texel.y / POINTS;
    vec2 place = (vec2(texel.x, texel.y % POINTS) + 0.5) / float(POINTS) * TILE[layer].xy;
    color = vec4(exp(-depth_in_layer(layer, vec3(place, BASE[layer]), 0.0, 0.5, false)));
}
