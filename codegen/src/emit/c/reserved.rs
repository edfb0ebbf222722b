//! Names that files and functions have in C already.

/// What a name is already.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Reserved {
    /// `NAME.h` of the C library, of POSIX or of a common system.
    Header,
    /// A word of C or C++.
    Word,
    /// A function of the C library.
    Function,
    /// `main`.
    Main,
    /// A name that no file can have on Windows.
    Device,
}

impl Reserved {
    /// A sentence about the name.
    pub(super) fn said(self, name: &str) -> String {
        match self {
            Self::Header => format!("`{name}.h` is a header of the system"),
            Self::Word => format!("`{name}` is a word of C or C++"),
            Self::Function => format!("`{name}` is a function of the C library"),
            Self::Main => format!("`{name}` is a function of every program"),
            Self::Device => {
                format!("`{name}` is a device of Windows, where no file can have this name")
            }
        }
    }
}

/// Headers of C23 and POSIX.1-2017, and of glibc, musl, macOS and Windows those with short names.
const HEADERS: &str = "
    assert complex ctype errno fenv inttypes iso646 limits locale math setjmp signal stdalign stdarg stdatomic stdbit
    stdbool stdckdint stddef stdint stdio stdlib stdnoreturn string tgmath threads time uchar wchar wctype
    aio cpio dirent dlfcn fcntl fmtmsg fnmatch ftw glob grp iconv langinfo libgen monetary mqueue ndbm netdb nl_types poll
    pthread pwd regex sched search semaphore spawn strings stropts syslog tar termios trace ulimit unistd utime utmpx wordexp
    aliases alloca ar argp argz byteswap crypt elf endian envz err error execinfo features fpu_control fstab fts getopt gshadow
    ieee754 ifaddrs lastlog libintl link malloc mcheck memory mntent nss obstack paths printf proc_service pty re_comp regexp
    resolv sgtty shadow stab stdc syscall sysexits termio thread_db ttyent ucontext ustat utmp values wait
    libc util unwind copyfile dispatch membership notify
    conio crtdbg direct dos io intrin mbstring process rpc share tchar windows winsock winsock2 wincon winnt winuser
";

/// Keywords of C23 and C++23, alternative spellings, macros that act as keywords.
const WORDS: &str = "
    alignas alignof and and_eq asm atomic auto bitand bitor bool break case catch char char8_t char16_t char32_t class compl
    concept const const_cast consteval constexpr constinit continue co_await co_return co_yield decltype default delete do
    double dynamic_cast else enum explicit export extern false final float for friend goto if import inline int long module
    mutable namespace new noexcept not not_eq nullptr operator or or_eq override private protected public register
    reinterpret_cast requires restrict return short signed sizeof static static_assert static_cast struct switch template this
    thread_local throw true try typedef typeid typename typeof typeof_unqual union unsigned using virtual void volatile wchar_t
    while xor xor_eq fortran linux unix i386 std
";

/// Functions of the C library, and those of POSIX that have short names.
const FUNCTIONS: &str = "
    acos acosh asin asinh atan atan2 atanh cbrt ceil copysign cos cosh drem erf erfc exp exp10 exp2 expm1 fabs fdim finite floor
    fma fmax fmin fmod frexp gamma hypot ilogb isfinite isinf isnan isnormal j0 j1 jn ldexp lgamma llrint llround log log10 log1p
    log2 logb lrint lround modf nan nearbyint nextafter nexttoward pow pow10 remainder remquo rint round scalb scalbln scalbn
    signbit significand sin sincos sinh sqrt tan tanh tgamma trunc y0 y1 yn
    abort abs atexit atof atoi atol atoll bsearch calloc div exit free getenv labs ldiv llabs lldiv mblen mbtowc qsort rand
    realloc srand strtod strtol strtoul system wctomb
    clearerr fclose feof ferror fflush fgetc fgets fopen fputc fputs fread freopen fscanf fseek ftell fwrite getc getchar gets
    perror putc putchar puts remove rename rewind scanf setbuf setvbuf sprintf sscanf tmpfile tmpnam ungetc fprintf snprintf
    memchr memcmp memcpy memmove memset strcat strchr strcmp strcoll strcpy strcspn strerror strlen strncat strncmp strncpy
    strpbrk strrchr strspn strstr strtok strxfrm index rindex bcmp bcopy bzero
    isalnum isalpha isblank iscntrl isdigit isgraph islower isprint ispunct isspace isupper isxdigit tolower toupper
    asctime clock ctime difftime gmtime localtime mktime strftime longjmp raise
    accept access alarm bind chdir chmod chown close connect creat dup execl execv fork fsync getpid gettid ioctl kill listen
    lseek mkdir mmap mount nice open pause pipe read readlink recv rmdir select send shutdown sleep socket stat stime sync
    symlink times truncate umask uname unlink usleep wait write yield
";

/// What a name in snake case is already.
pub(super) fn what(name: &str) -> Option<Reserved> {
    let is_among = |names: &str| names.split_whitespace().any(|known| known == name);
    if name == "main" {
        Some(Reserved::Main)
    } else if is_device(name) {
        Some(Reserved::Device)
    } else if is_among(HEADERS) {
        Some(Reserved::Header)
    } else if is_among(WORDS) {
        Some(Reserved::Word)
    } else if is_among(FUNCTIONS) {
        Some(Reserved::Function)
    } else {
        None
    }
}

/// `con`, `com3` and the like, whatever stands behind the dot.
fn is_device(name: &str) -> bool {
    let numbered = ["com", "lpt"]
        .iter()
        .find_map(|kind| name.strip_prefix(kind));
    ["aux", "con", "nul", "prn"].contains(&name)
        || numbered.is_some_and(|rest| rest.len() == 1 && rest.chars().all(|c| c.is_ascii_digit()))
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    #[test]
    fn a_name_stands_in_one_list_once() {
        let mut seen = BTreeSet::new();
        for list in [HEADERS, WORDS] {
            for name in list.split_whitespace() {
                assert!(seen.insert(name), "{name}");
                assert!(what(name).is_some(), "{name}");
            }
        }
        let mut functions = BTreeSet::new();
        for name in FUNCTIONS.split_whitespace() {
            assert!(
                functions.insert(name) && !name.contains(char::is_uppercase),
                "{name}"
            );
        }
    }
}
