// What the writer and the reader of manifests agree on.
#pragma once

namespace skybake {

// The version of the manifest's form. A reader refuses another one. What changed from one to the
// next stands in the description of manifest_schema.json.
inline constexpr int manifest_format = 3;

}  // namespace skybake
