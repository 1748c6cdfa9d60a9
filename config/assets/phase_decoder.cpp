#include "config/assets/phase_decoder.h"

#include <fmt/format.h>

#include <span>

#include "config/fields/named_reference.h"
#include "config/text/key_path.h"

namespace skybake::config {

void check_phase(const DecodedSection& bake, const Parameters& recipe, Decoder& decoder) {
    const DecodedField& particles = bake.at("particles");
    const DecodedField& layer = bake.at("layer");
    if (!particles.source && !layer.source) {
        if (!decoder.complete) return;
        decoder.diagnostics.error(
            "E0141", bake.place,
            fmt::format("[{}] does not say whose phase function to bake", bake.path),
            "name `particles` or a `layer`");
        return;
    }
    if (particles.value) {
        find_named(bake, "particles", std::span<const Particles>(recipe.particles),
                   particles_reference, decoder);
    }
    if (layer.value) {
        find_named(bake, "layer", std::span<const Layer>(recipe.atmosphere.layers), layer_reference,
                   decoder);
    }
}

}  // namespace skybake::config
