# Makes Gmsh's format 2.2 fit for gmshToFoam: names of groups are single words, and each triangle is in its main group
# alone. Gmsh writes it again for its part and for each further table; lines and points of groups of edges go.
# usage: awk -f patches.awk filled.msh filled.msh      the file is read twice

function is_extra(name) { return name ~ /^"(part|group_[A-Za-z0-9_-]+):/ }

/^\$/ { section = $1; row = 0; if (FNR != NR) print; next }
{ ++row }

FNR == NR {  # first: which groups go, how many names and elements stay
  if (section == "$PhysicalNames" && row > 1) {
    if (is_extra($3) || $1 < 2) goes[$1 " " $2]; else ++n_names
  }
  if (section == "$Elements" && row > 1) {
    if ($2 == 2 && !(("2 " $4) in goes) || $2 == 4) ++n_elements
  }
  next
}

section == "$PhysicalNames" && row == 1 { print n_names; next }
section == "$PhysicalNames" {
  if (($1 " " $2) in goes) next
  match($0, /".*"/)
  name = substr($0, RSTART + 1, RLENGTH - 2)
  gsub(/[^A-Za-z0-9_.:-]/, "_", name)
  if (name in used) name = name "_" $2
  used[name]
  print $1, $2, "\"" name "\""
  next
}
section == "$Elements" && row == 1 { print n_elements; next }
section == "$Elements" {
  if ($2 == 2 && !(("2 " $4) in goes) || $2 == 4) print
  next
}
{ print }
