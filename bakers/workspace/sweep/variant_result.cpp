#include "bakers/workspace/sweep/variant_result.h"

namespace skybake {

VariantAsset variant_asset(const ManifestAsset& entry) {
    VariantAsset asset;
    asset.name = entry.name;
    asset.kind = entry.kind;
    asset.key = entry.key;
    asset.size = entry.size;
    asset.content_hash = entry.content_hash;
    for (const ManifestFile& file : entry.files) asset.files.push_back(file.path);
    if (entry.error) {
        asset.lookup_error = entry.error->lookup;
        asset.texel_error = entry.error->texel;
    }
    return asset;
}

std::string_view spell(VariantStatus status) {
    switch (status) {
        case VariantStatus::done:
            return "done";
        case VariantStatus::failed:
            return "failed";
        case VariantStatus::missing:
            break;
    }
    return "missing";
}

}  // namespace skybake
