// SPDX-License-Identifier: Apache-2.0
#include "io/way_on.hpp"

#include "base/process/shell_word.hpp"

namespace dust::io {

std::string way_on_from_checkpoint(const std::filesystem::path& folder) {
  return "the checkpoint is whole: go on from it to the same bits in another folder with --set " +
         base::shell_word("start_from=" + folder.string()) +
         " and another -o, without --resume; or start again with --force, which loses it";
}

}  // namespace dust::io
