# Prints what 'afpc robot setup' needs to know about this computer. Nothing is changed.
say() { echo "afp: $1 $2"; }
say system "$(uname -s)"
say machine "$(uname -m)"
say bits "$(getconf LONG_BIT 2>/dev/null)"
say libc "$(getconf GNU_LIBC_VERSION 2>/dev/null)"
if [ -d /run/systemd/system ]; then say systemd yes; fi
if [ -e /usr/local/bin/afpc ]; then say afpc yes; fi
if [ "$(id -u)" = 0 ]; then
    say root yes
elif ! command -v sudo >/dev/null; then
    say root no
elif sudo -n true 2>/dev/null; then
    say root sudo
else
    say root password
fi
