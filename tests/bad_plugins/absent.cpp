// SPDX-License-Identifier: Apache-2.0
/// Of the library that missing_library is linked with and cannot find.
extern "C" __attribute__((visibility("default"))) double absent_factor() { return 1.0; }
