# SPDX-License-Identifier: MIT
# Runs a writer of pages with the date of the commit.
file(READ "${DATE}" date)
string(STRIP "${date}" date)
execute_process(COMMAND "${WRITER}" "${FOLDER}" "${date}" "${VERSION}" COMMAND_ERROR_IS_FATAL ANY)
