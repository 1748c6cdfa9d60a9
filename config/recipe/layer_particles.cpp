#include "config/recipe/layer_particles.h"

#include <string>
#include <utility>

#include "config/recipe/merge.h"

namespace skybake::config {
namespace {

Table* table_at(Table& parent, std::string_view key) {
    Entry* entry = find_entry(parent, key);
    return entry ? std::get_if<Table>(&entry->value.data) : nullptr;
}

// Any other layer stays as it is, so that its fault is reported.
void name_particles(Table& layer) {
    Entry* phase = find_entry(layer, "phase");
    const Table* inner = phase ? as_table(phase->value) : nullptr;
    const bool is_mie = inner && inner->size() == 1 && inner->front().key == "mie";
    if (!is_mie || find_entry(layer, "particles")) return;
    Entry particles = inner->front();
    phase->value.data = std::string("mie");
    particles.key = "particles";
    merge(layer, {std::move(particles)});
}

}  // namespace

void name_particles_of_layers(Table& root) {
    Table* atmosphere = table_at(root, "atmosphere");
    Table* layers = atmosphere ? table_at(*atmosphere, "layers") : nullptr;
    if (!layers) return;
    for (Entry& entry : *layers) {
        if (auto* layer = std::get_if<Table>(&entry.value.data)) name_particles(*layer);
    }
}

bool names_particles(const Table& layer) {
    const Entry* phase = find_entry(layer, "phase");
    const auto* text = phase ? std::get_if<std::string>(&phase->value.data) : nullptr;
    return text && *text == "mie";
}

}  // namespace skybake::config
