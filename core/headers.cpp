// SPDX-License-Identifier: Apache-2.0
// Empty: the precompiled headers of rooms and plugins need a file that owns them.
