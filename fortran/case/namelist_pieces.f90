! SPDX-License-Identifier: BSD-3-Clause
!> Split namelist text into pieces `key = value` with group and line. The intrinsic read accepts too much: it reads '600 N' as 600,
!> ignores a word without quotes, and finds a group inside a comment.
module ehl_namelist_pieces
   use ehl_status, only: ehl_bad_input, status_t
   use ehl_text, only: lower_case, newline, to_text
   implicit none (type, external)
   private
   public :: keep_pieces, piece_t, split_text, name_length, mark_default, mark_derived

   integer, parameter :: name_length = 32
   !> Marks at the end of lines that were not given: constant defaults, and values derived from other keys
   character(len=*), parameter :: mark_default = "! default", mark_derived = "! derived"

   type :: piece_t
      character(len=name_length) :: group = "", key = ""
      !> The values, separated by commas, and their number
      character(len=:), allocatable :: value
      integer :: values = 0
      !> Line number, or the option as typed
      integer :: line = 0
      character(len=:), allocatable :: option
      !> Whether the text marks it as not given
      logical :: marked = .false.
   contains
      procedure :: name => piece_name
   end type piece_t

   type :: token_t
      !> 'w'ord, 's'tring, 'c'omment, 'e'nd, 'u'nfinished string, '=', ',', '&' or '/'
      character(len=1) :: kind = "e"
      integer :: first = 1, last = 0
   end type token_t

   !> Blanks, and all characters that end a word
   character(len=*), parameter :: blanks = " "//achar(9)//achar(13)//newline, ends = blanks//",=/!&'"""

contains

   !> group.key
   pure function piece_name(self) result(name)
      class(piece_t), intent(in) :: self
      character(len=len_trim(self%group) + 1 + len_trim(self%key)) :: name

      name = trim(self%group)//"."//trim(self%key)
   end function piece_name

   !> Split a text into pieces
   subroutine split_text(origin, text, pieces, status)
      !> Name of the text, for messages
      character(len=*), intent(in) :: origin, text
      type(piece_t), allocatable, intent(out) :: pieces(:)
      type(status_t), intent(inout) :: status
      type(token_t) :: token, next
      character(len=:), allocatable :: group
      integer :: position, n, k
      logical :: behind_value

      behind_value = .false.
      allocate (pieces(count([(text(k:k) == "=", k=1, len(text))])))
      n = 0
      group = ""
      position = 1
      do while (.not. status%failed())
         call take(token, position)
         k = position
         call take(next, k)
         select case (token%kind)
         case ("e")
            if (group /= "") call refuse("&"//group//" has no end", "'/' after its last key")
            exit
         case ("c")
            if (n > 0) pieces(n)%marked = pieces(n)%marked .or. is_marked(text(token%first:token%last))
         case ("&")
            if (group /= "") call refuse("&"//group//" has no end before the next group", "'/' after its last key")
            group = lower_case(text(token%first + 1:token%last))
            if (any(pieces(:n)%group == group)) call refuse("&"//group//" is given twice", "every group once")
            if (group == "") call refuse("a group without a name", "for example &contact")
         case ("/")
            if (group == "") call refuse("'/' without a group", "&group before it")
            group = ""
         case ("w", "s")
            if (group == "") then
               call refuse("text outside a group: "//text(token%first:token%last), "&group key = value /")
            else if (token%kind == "w" .and. next%kind == "=") then
               n = n + 1
               pieces(n)%group = group
               pieces(n)%key = lower_case(text(token%first:token%last))
               pieces(n)%value = ""
               pieces(n)%line = line_of(token%first)
               position = k
            else if (.not. has_key()) then
               call refuse("a value without a key in &"//group//": "//text(token%first:token%last), "key = value")
            else
               if (pieces(n)%values > 0) pieces(n)%value = pieces(n)%value//", "
               pieces(n)%value = pieces(n)%value//text(token%first:token%last)
               pieces(n)%values = pieces(n)%values + 1
            end if
         case (",")
            if (.not. behind_value) call refuse("a comma that follows no value in &"//group//last_key(), &
                                                "key = value, or a list of values")
         case ("u")
            call refuse("a text without its closing quote", "'...'")
         case default
            call refuse("'=' without a key", "key = value")
         end select
         if (token%kind /= "c") behind_value = any(token%kind == ["w", "s"]) .and. position /= k
      end do
      call keep_pieces(pieces, [(k <= n, k=1, size(pieces))])

   contains

      !> Find the next token, and the position after it
      subroutine take(found, at)
         type(token_t), intent(out) :: found
         integer, intent(inout) :: at
         character(len=1) :: first

         found%first = at + verify(text(min(at, len(text) + 1):), blanks) - 1
         if (found%first < at) return
         first = text(found%first:found%first)
         found%last = found%first
         select case (first)
         case ("!")
            found%kind = "c"
            found%last = found%first + index(text(found%first:)//newline, newline) - 2
         case ("=", "/", ",")
            found%kind = first
         case ("'", """")
            found%kind = "s"
            do
               associate (n => index(text(found%last + 1:), first))
                  found%last = found%last + n
                  if (n == 0 .or. index(text(found%first:found%last), newline) > 0) then
                     found%kind = "u"
                     exit
                  end if
               end associate
               if (text(found%last + 1:min(found%last + 1, len(text))) /= first) exit
               found%last = found%last + 1
            end do
         case default
            found%kind = merge("&", "w", first == "&")
            found%last = found%first + scan(text(found%first + 1:)//" ", ends) - 1
         end select
         at = found%last + 1
      end subroutine take

      !> Name of the previous key, if any
      function last_key() result(words)
         character(len=:), allocatable :: words
         words = ""
         if (has_key()) words = ", after "//pieces(n)%name()
      end function last_key

      !> Whether values can belong to a previous piece
      logical function has_key()
         has_key = .false.
         if (n > 0) has_key = pieces(n)%group == group
      end function has_key

      integer function line_of(place)
         integer, intent(in) :: place
         line_of = 1 + count([(text(k:k) == newline, k=1, place - 1)])
      end function line_of

      subroutine refuse(what, expected)
         character(len=*), intent(in) :: what, expected
         call status%fail(ehl_bad_input, origin//":"//to_text(line_of(min(token%first, len(text))))//": error: "//what//newline// &
                          "expected: "//expected)
      end subroutine refuse
   end subroutine split_text

   !> Keep some pieces, and add others, one by one: array constructors and pack share the texts of their copies (gfortran 12)
   subroutine keep_pieces(pieces, selected, more)
      type(piece_t), allocatable, intent(inout) :: pieces(:)
      logical, intent(in) :: selected(:)
      type(piece_t), intent(in), optional :: more(:)
      type(piece_t), allocatable :: kept(:)
      integer :: k, n

      n = count(selected)
      if (present(more)) n = n + size(more)
      allocate (kept(n))
      n = 0
      do k = 1, size(selected)
         if (.not. selected(k)) cycle
         n = n + 1
         kept(n) = pieces(k)
      end do
      do k = n + 1, size(kept)
         kept(k) = more(k - n)
      end do
      call move_alloc(kept, pieces)
   end subroutine keep_pieces

   !> Whether a comment ends with a mark
   pure logical function is_marked(comment)
      character(len=*), intent(in) :: comment
      is_marked = index(comment, mark_default, back=.true.) > max(0, len_trim(comment) - len(mark_default)) .or. &
                  index(comment, mark_derived, back=.true.) > max(0, len_trim(comment) - len(mark_derived))
   end function is_marked
end module ehl_namelist_pieces
