# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# Completion of impinge in fish: `impinge complete` knows the words, this hands them on.

function __impinge_complete
    set -l words (commandline -opc)
    for line in ($words[1] complete (commandline -cp | string collect) 2>/dev/null)
        if test "$line" = :files
            __fish_complete_path (commandline -ct)
        else
            echo $line
        end
    end
end
complete -c impinge -f -a '(__impinge_complete)'
