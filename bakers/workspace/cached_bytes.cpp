#include "bakers/workspace/cached_bytes.h"

#include "bakers/io/files/file_io.h"
#include "bakers/io/manifest/release.h"
#include "bakers/math/hash.h"
#include "bakers/workspace/asset_cache.h"
#include "bakers/workspace/folder_plan.h"

namespace skybake {

namespace {

AssetIdentity identity_of(const KeptBytes::Name& name) {
    AssetIdentity identity;
    identity.kind = name.kind;
    identity.release = release();
    identity.baker_version = name.version;
    identity.parameters = name.parameters;
    identity.key = key_of(identity);
    return identity;
}

// The entry of a manifest has the form of an asset's: a table without channels.
ManifestAsset entry_of(const KeptBytes::Name& name, std::string_view bytes) {
    ManifestAsset entry;
    entry.name = name.kind;
    entry.kind = name.kind;
    entry.content = "what assets are made from";
    entry.release = release();
    entry.axes.resize(2);
    entry.size = {1, 1};
    entry.levels.emplace_back().size = {1, 1, 1};
    entry.files.emplace_back();
    entry.files[0].path = name.kind;
    entry.files[0].format = "bin";
    entry.files[0].compression = "none";
    entry.files[0].bytes = bytes.size();
    entry.files[0].xxh3 = xxh3_hex(bytes);
    entry.parameters = name.parameters;
    sign(identity_of(name), entry);
    return entry;
}

}  // namespace

std::optional<std::string> CachedBytes::find(const Name& name) {
    AssetCache cache(cache_);
    const auto ready = cache.find(identity_of(name).key);
    if (!ready || ready->entry.files.size() != 1) return std::nullopt;
    const ManifestFile& file = ready->entry.files[0];
    auto bytes = read_file(ready->folder / file.path, file.bytes);
    if (bytes.value && xxh3_hex(*bytes.value) == file.xxh3) return std::move(*bytes.value);
    cache.reject(*ready);
    return std::nullopt;
}

void CachedBytes::keep(const Name& name, std::string_view bytes) {
    if (!cache_.empty()) AssetCache(cache_).offer(bytes, entry_of(name, bytes));
}

}  // namespace skybake
