"""Fails where a program or library for Windows asks for what not every Windows has: imports.py FILE."""

import sys

import pefile

# Of the system, by the beginning of their names; python3 is the stable interface of any Python from 3.9 on.
KNOWN = ("advapi32", "api-ms-win-", "bcrypt", "gdi32", "kernel32", "msvcrt", "ntdll", "ole32", "oleaut32", "shell32",
         "user32", "userenv", "ws2_32", "python3.")

file = pefile.PE(sys.argv[1])
asked = sorted({entry.dll.decode().lower() for entry in file.DIRECTORY_ENTRY_IMPORT})
strange = [name for name in asked if not name.startswith(KNOWN)]
print(f"{sys.argv[1]} asks for {' '.join(asked)}")
if strange:
    sys.exit(f"not every Windows has {' '.join(strange)}")
