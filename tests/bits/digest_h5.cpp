// SPDX-License-Identifier: Apache-2.0
#include "io/run_files.hpp"

#include <hdf5.h>

#include <iostream>
#include <string>
#include <vector>

/// digest_h5 FILE...: one line `dataset digest` for each dataset and attribute of HDF5 files: type
/// class, shape and values, not how they are stored. Status 1 for what cannot be read: nothing is
/// passed over.
namespace {

using dust::io::Sha256;

struct Reader {
  bool is_complete = true;

  void put_shape(hid_t space, hid_t type, Sha256& sum) const {
    hsize_t shape[H5S_MAX_RANK] = {};
    const int rank = H5Sget_simple_extent_ndims(space);
    H5Sget_simple_extent_dims(space, shape, nullptr);
    const int kind[3] = {static_cast<int>(H5Tget_class(type)), rank,
                         static_cast<int>(H5Tget_size(type))};
    sum.update(kind, sizeof kind);
    sum.update(shape, static_cast<std::size_t>(rank) * sizeof(hsize_t));
  }

  template <class Read>
  void put(const std::string& name, hid_t space, hid_t type, Read read) {
    Sha256 sum;
    put_shape(space, type, sum);
    const auto count = static_cast<std::size_t>(H5Sget_simple_extent_npoints(space));
    if (H5Tis_variable_str(type) > 0) {
      std::vector<char*> text(count);
      is_complete &= read(type, static_cast<void*>(text.data())) >= 0;
      for (char* t : text) {
        const std::string s = t == nullptr ? "" : t;
        sum.update(s.c_str(), s.size() + 1);
      }
      H5Dvlen_reclaim(type, space, H5P_DEFAULT, text.data());
    } else {
      std::vector<char> bytes(count * H5Tget_size(type));
      if (!bytes.empty()) is_complete &= read(type, static_cast<void*>(bytes.data())) >= 0;
      sum.update(bytes.data(), bytes.size());
    }
    std::cout << name << '\t' << sum.hex_digest() << '\n';
  }
};

herr_t visit_attribute(hid_t object, const char* name, const H5A_info_t* /*info*/, void* data) {
  auto& [reader, path] = *static_cast<std::pair<Reader*, std::string>*>(data);
  const hid_t attribute = H5Aopen(object, name, H5P_DEFAULT);
  const hid_t space = H5Aget_space(attribute);
  const hid_t type = H5Aget_type(attribute);
  reader->put(path + "@" + name, space, type,
              [&](hid_t t, void* to) { return H5Aread(attribute, t, to); });
  H5Tclose(type), H5Sclose(space), H5Aclose(attribute);
  return 0;
}

herr_t visit(hid_t file, const char* name, const H5O_info_t* info, void* data) {
  auto* const reader = static_cast<Reader*>(data);
  const hid_t object = H5Oopen(file, name, H5P_DEFAULT);
  std::pair<Reader*, std::string> place{reader, name};
  H5Aiterate2(object, H5_INDEX_NAME, H5_ITER_INC, nullptr, visit_attribute, &place);
  if (info->type == H5O_TYPE_DATASET) {
    const hid_t space = H5Dget_space(object);
    const hid_t type = H5Dget_type(object);
    reader->put(name, space, type, [&](hid_t t, void* to) {
      return H5Dread(object, t, H5S_ALL, H5S_ALL, H5P_DEFAULT, to);
    });
    H5Tclose(type), H5Sclose(space);
  }
  H5Oclose(object);
  return 0;
}

}  // namespace

int main(int count, char** arguments) {
  Reader reader;
  for (int n = 1; n < count; ++n) {
    const hid_t file = H5Fopen(arguments[n], H5F_ACC_RDONLY, H5P_DEFAULT);
    if (file < 0) return 1;
    std::cout << "file\t" << arguments[n] << '\n';
    if (H5Ovisit2(file, H5_INDEX_NAME, H5_ITER_INC, visit, &reader, H5O_INFO_BASIC) < 0) return 1;
    H5Fclose(file);
  }
  return reader.is_complete ? 0 : 1;
}
