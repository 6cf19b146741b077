// SPDX-License-Identifier: Apache-2.0
// Empty: the precompiled headers of rooms and plugins, and those of tests, need a file that owns
// them.
