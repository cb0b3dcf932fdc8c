#!/bin/sh
# Makes the font files of this folder. Needs npm, Debian's fonts-dejavu-core and fonts-droid-fallback, and Python with
# fonttools 4.68. With `chinese` it makes only the Chinese ones: run it when the Chinese texts use new characters.
# Usage: assets/fonts/subset.sh [chinese]
set -eu
here=$(cd "$(dirname "$0")" && pwd)
dejavu=/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf
droid=${DROID:-/usr/share/fonts-droid-fallback/truetype/DroidSansFallback.ttf}
work=$(mktemp -d)
trap 'rm -r "$work"' EXIT
cd "$work"

# What the Chinese texts use beyond Latin and Greek, and the name of the language, which is always needed.
ideographs() {
    cat "$here"/../text/zh.json "$here"/../lessons/*.json | python3 -c "
import sys
print(''.join(sorted({letter for letter in sys.stdin.read() if letter >= chr(0x2e80)})))"
}
chinese() {
    pyftsubset "$droid" --text="$1" --layout-features='' --no-hinting --notdef-outline \
        --name-IDs='0,1,2,5,13,14' --drop-tables+=DSIG,GSUB,GPOS,GDEF,vhea,vmtx --output-file="$here/$2"
}
chinese "$(ideographs)" DroidSansFallback-subset.ttf
chinese 中文 DroidSansFallback-name.ttf
[ "${1:-}" != chinese ] || exit 0

npm pack --silent @expo-google-fonts/inter@0.4.2
tar xzf expo-google-fonts-inter-0.4.2.tgz

# Tabular digits: the shapes of the font's `tnum` feature become the digits themselves.
freeze() {
    python3 - "$1" "$2" <<'PYTHON'
import sys
from fontTools.ttLib import TTFont
font = TTFont(sys.argv[1], recalcTimestamp=False)
tabular = {}
gsub = font["GSUB"].table
for record in gsub.FeatureList.FeatureRecord:
    if record.FeatureTag == "tnum":
        for index in record.Feature.LookupListIndex:
            for subtable in gsub.LookupList.Lookup[index].SubTable:
                tabular.update(getattr(subtable, "ExtSubTable", subtable).mapping)
for table in font["cmap"].tables:
    for code in range(0x30, 0x3A):
        if code in table.cmap:
            table.cmap[code] = tabular.get(table.cmap[code], table.cmap[code])
font.save(sys.argv[2])
PYTHON
}

letters="U+0020-007E,U+00A0-00FF,U+0131,U+02C6,U+02DA,U+02DC,U+0307,U+0308,U+0300,U+0301,U+0302,U+0304"
letters="$letters,U+0391-03A1,U+03A3-03A9,U+03B1-03C9,U+03D5,U+1E8B,U+1E8F,U+017C"
raised="U+1D62,U+2070,U+2071,U+2074-208E,U+2091,U+2096,U+2099"
marks="U+2010-2015,U+2018-201A,U+201C-201E,U+2020,U+2022,U+2026,U+2030,U+2032,U+2033,U+2044,U+20AC,U+2126"
signs="U+2190-2194,U+2202,U+2206,U+2211,U+2212,U+221A,U+221E,U+222B,U+2248,U+2260,U+2264,U+2265,U+2295"
shapes="U+25A0,U+25B2,U+25BC,U+25B6,U+25C0,U+25C6,U+25CB,U+25CF,U+2713"
all="$letters,$raised,$marks,$signs,$shapes"
# Titles and selected things; whatever else stands there is taken from the normal weight.
titles="U+0020-007E,U+00B0,U+00B2,U+00B7,U+00C4,U+00D6,U+00D7,U+00DC,U+00DF,U+00E4,U+00E9,U+00F6,U+00FC"
titles="$titles,U+03B1,U+03B2,U+03B7,U+03B8,U+03BA,U+03C9,U+2013,U+2014,U+2019,U+2026,U+2212,U+2080-2082"
for weight in 400Regular 600SemiBold; do
    unicodes="$all"
    [ $weight = 400Regular ] || unicodes="$titles"
    freeze "package/$weight/Inter_$weight.ttf" "$weight.ttf"
    pyftsubset "$weight.ttf" --unicodes="$unicodes" \
        --layout-features='kern,mark,mkmk,ccmp' --no-hinting --desubroutinize --notdef-outline \
        --name-IDs='0,1,2,5,13,14' --drop-tables+=DSIG,STAT,MVAR,HVAR \
        --output-file="$here/Inter-${weight#[0-9][0-9][0-9]}-subset.ttf"
done

extra="U+25B8,U+25BE,U+25C2,U+25B4,U+2715,U+27F2,U+27F3,U+221D,U+2208,U+2299,U+21BA,U+2A2F,U+2223,U+2225,U+2261"
pyftsubset "$dejavu" --unicodes="$extra,U+2295,U+22C5,U+1D62,U+2C7C,U+2096,U+2091,U+2099,U+209A,U+2098" \
    --layout-features='' --no-hinting --name-IDs='0,1,2,5' --drop-tables+=FFTM,MATH,GPOS,GSUB,GDEF \
    --output-file="$here/DejaVuSans-symbols.ttf"
ls -l "$here"/*.ttf
