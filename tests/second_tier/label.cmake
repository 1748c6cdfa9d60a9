set_tests_properties(
    bytes.compilers
    bytes.targets
    HonestClaims.HoldOnTwelveAtmospheres
    incremental.KeyCoversBytes.WhateverChangesOfClouds
    incremental.KeyCoversBytes.WhateverChangesOfTheSky
    incremental.KeyCoversBytes.WhateverElseChanges
    install.package_archive
    lookups.compile_printed_glsl
    pipelines.cache
    pipelines.http_cache
    pipelines.killed
    pipelines.killed_frames
    pipelines.killed_sweep
    pipelines.several_processes
    report.program
    PROPERTIES LABELS more)
