// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <hdf5.h>

namespace dust::io {

/// HDF5 1.10 keeps a file open that it cannot write to its end, and its exit handler ends the
/// program with a segmentation fault. Files that we write therefore go through a driver that
/// notes the first failure and lets the library believe that all went well, so that it closes
/// the file. The caller asks, and throws the file away.
///
/// Sets the driver of files that are created with `access`.
void use_output_driver(hid_t access);

/// Throws base::WriteError if something could not be written by this thread since the last call.
void require_written();
/// Clears what was not written before.
void clear_write_failure();

}  // namespace dust::io
